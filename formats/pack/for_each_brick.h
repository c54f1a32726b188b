// Walks over the bricks of a grid with the voxel coordinates of each, which no record stores.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/bricks.h"

#include <span>

namespace hearth::formats
{

/// Coordinates of a voxel, or of the lowest voxel of a brick.
struct VoxelCoordinates
{
    uint32_t x;
    uint32_t y;
    uint32_t z;
};

/// Return the cell at a bit, `size` voxels each way, of the group or brick whose lowest voxel is `first`.
constexpr VoxelCoordinates voxelAtBit(VoxelCoordinates first, uint32_t bit, uint32_t size)
{
    return {first.x + (bit & 3u) * size, first.y + (bit >> 2 & 3u) * size, first.z + (bit >> 4) * size};
}

/// Call `use(group, first)` for every group of a grid with this many voxels, in the order of chunk BRKG.
template <typename Use>
void forEachGroupOfGrid(const uint32_t (&voxels)[3], Use use)
{
    uint32_t group = 0;
    for (uint32_t z = 0; z < voxels[2]; z += shared::kGroupVoxels)
        for (uint32_t y = 0; y < voxels[1]; y += shared::kGroupVoxels)
            for (uint32_t x = 0; x < voxels[0]; x += shared::kGroupVoxels)
                use(group++, VoxelCoordinates{x, y, z});
}

/// Call `use(brick, first)` for every brick, in the order of chunk BRKB. `groups` are valid as the checker
/// accepts them.
template <typename Use>
void forEachBrickOfGrid(const BrickGridRecord& grid, std::span<const BrickGroupRecord> groups, Use use)
{
    forEachGroupOfGrid(grid.voxels,
                       [&](uint32_t group, VoxelCoordinates first)
                       {
                           const BrickGroupRecord& record = groups[group];
                           uint32_t brick = record.first_brick;
                           for (uint32_t bit = 0; bit < 64; ++bit)
                               if (shared::maskHas(record.brick_mask_low, record.brick_mask_high, bit))
                                   use(brick++, voxelAtBit(first, bit, shared::kBrickVoxels));
                       });
}

} // namespace hearth::formats
