// Placement of a voxel grid in world space.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/affine3d.h"

#include <array>
#include <cstdint>

namespace hearth::bricks
{

using Cell = std::array<uint32_t, 3>;

/// Placement of a grid: voxel (x, y, z) begins at origin + voxel_size * (x, y, z).
struct GridFrame
{
    Float3 origin;        ///< world space, metres
    float voxel_size = 1; ///< metres, > 0
    Cell voxels{};        ///< count along each axis, 1 to formats::kMaxGridVoxels

    /// Return the number of groups along each axis. The last groups may extend beyond the grid.
    Cell groups() const
    {
        Cell count;
        for (size_t axis = 0; axis < 3; ++axis)
            count[axis] = (voxels[axis] + 15) / 16;
        return count;
    }
    uint64_t groupCount() const { return uint64_t{groups()[0]} * groups()[1] * groups()[2]; }
};

/// Transform from object space to voxel coordinates relative to the grid's origin.
inline Affine3d voxelsFromObject(const GridFrame& frame, const Affine3& world_from_object)
{
    const double size = frame.voxel_size;
    Affine3d transform = widened(world_from_object);
    for (int axis = 0; axis < 3; ++axis)
    {
        transform.m[axis][3] -= frame.origin[axis];
        for (double& entry : transform.m[axis])
            entry /= size;
    }
    return transform;
}

} // namespace hearth::bricks
