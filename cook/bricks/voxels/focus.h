// Distances to the focus points of a scene. Bricks far from them are dropped first if the memory budget is
// exceeded.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/grid_frame.h"

#include <limits>
#include <span>

namespace hearth::bricks
{

/// Return the distance in metres from a box of cells to the nearest focus point.
/// foci       world space, at least one
/// low, high  corners of the box, in voxels; equal for a point
inline double focusDistance(const GridFrame& frame, std::span<const Float3> foci, Double3 low, Double3 high)
{
    const auto outside = [](double low_end, double high_end, double at) {
        return std::max({low_end - at, at - high_end, 0.0});
    };
    double nearest = std::numeric_limits<double>::infinity();
    for (const Float3& focus : foci)
    {
        const Double3 at = (widen(focus) - widen(frame.origin)) * (1.0 / frame.voxel_size);
        nearest = std::min(nearest, length(Double3{outside(low.x, high.x, at.x), outside(low.y, high.y, at.y),
                                                   outside(low.z, high.z, at.z)}));
    }
    return nearest * frame.voxel_size;
}

/// Return the distance in metres from the middle of a brick to the nearest focus point.
/// brick  lowest cell of the brick
inline double brickDistance(const GridFrame& frame, std::span<const Float3> foci, const Cell& brick)
{
    const Double3 middle{brick[0] + 2.0, brick[1] + 2.0, brick[2] + 2.0};
    return focusDistance(frame, foci, middle, middle);
}

} // namespace hearth::bricks
