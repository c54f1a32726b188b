// Settings of a brick grid, and the placement of its voxels that follows from them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/grid_frame.h"
#include "formats/base/result.h"

#include <optional>
#include <vector>

namespace hearth::bricks
{

struct GridSettings
{
    std::optional<double> voxel_size;     ///< metres; none: see firstVoxelSize
    std::optional<Double3> min, max;      ///< world space, both or none; none: around the static instances
    std::vector<Float3> seeds;            ///< positions that count as visible, like cameras
    uint64_t memory = uint64_t{20} << 20; ///< budget of all tables on the GPU, bytes
    /// LOD error that clusters may have, as a share of a voxel. Costs are measured in cook/bricks/README.md.
    double error_share = 0.25;
};

/// Return the first voxel size to try when none is set: 512 voxels along the longest side, or up to a ninth
/// more. It is not below 0.1 m, unless that gives less than 64 voxels. The result is rounded up to a number
/// of the series R10: 1, 1.25, 1.6, 2, 2.5, ...
double firstVoxelSize(const Box3& box);

/// Return the next larger number of the series.
double nextVoxelSize(double size);

/// Compute the placement of a grid. Without an extent the voxels lie on multiples of their size, with room
/// for the voxel behind a surface that lies in a side of the box. A given extent is kept; its last voxels may
/// reach beyond it.
///
/// box   bounds of the static instances, world space; empty: one voxel at the origin
/// size  voxel size, metres
/// errors: usage where the settings make no sense, where a side is longer than formats::kMaxGridVoxels, or
/// where the empty grid alone needs more than settings.memory
Result<GridFrame> makeGridFrame(const GridSettings& settings, const Box3& box, double size);

} // namespace hearth::bricks
