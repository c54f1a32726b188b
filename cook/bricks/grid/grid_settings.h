// What a grid of bricks shall be, and where its voxels lie by that.
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
    std::optional<Double3> min, max;      ///< world space, both or none; none: around what stands still
    std::vector<Float3> seeds;            ///< places that are seen, as those of cameras are
    uint64_t memory = uint64_t{20} << 20; ///< of the GPU, bytes, that all tables together may take
    /// Clusters may be off by so much of a voxel. cook/bricks/README.md has what it costs.
    double error_share = 0.25;
};

/// The voxel size to try first where none is asked for: 512 voxels along the longest side, or up to a ninth more; but no finer
/// than a tenth of a metre, unless that were less than 64 voxels. Rounded up to a number of the series R10: 1, 1.25, 1.6, 2, 2.5, ...
double firstVoxelSize(const Box3& box);

/// The next larger number of the series.
double nextVoxelSize(double size);

/// The frame of a grid with these settings. Without an extent the voxels lie on multiples of their size, with room for the
/// voxel behind what lies in the box's sides; an extent is taken as it is, its last voxels may reach beyond.
///
/// box   world space, of what stands still; empty: one voxel at the origin
/// size  metres
/// errors: usage, where the settings make no sense, a side is longer than formats::kMaxGridVoxels, or where the empty grid
/// alone would take more than settings.memory
Result<GridFrame> frameOf(const GridSettings& settings, const Box3& box, double size);

} // namespace hearth::bricks
