// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/visible_faces.h"

#include "cook/bricks/voxels/for_each_voxel.h"
#include "cook/bricks/voxels/opacity.h"

namespace hearth::bricks
{

std::vector<uint8_t> visibleFaces(const SolidGrid& grid, const EmptySpaces& spaces, const VisibleSpaces& seen,
                                  std::span<const uint32_t> space_of_voxel)
{
    const auto isSeen = [&](const Cell& cell)
    {
        const uint32_t voxel = isInside(grid.frame, cell) ? grid.voxelAt(cell) : kInvalidIndex;
        if (voxel == kInvalidIndex)
            return static_cast<bool>(seen.seen[spaces.at(grid, cell)]);
        return grid.voxels[voxel].opacity != kOpaque && space_of_voxel[voxel] != kInvalidIndex &&
               seen.seen[space_of_voxel[voxel]];
    };
    std::vector<uint8_t> faces(grid.voxels.size());
    forEachVoxel(grid,
                 [&](uint32_t voxel, const Cell& cell)
                 {
                     for (uint32_t face = 0; face < kFaces; ++face)
                         if (isSeen(across(cell, face)))
                             faces[voxel] |= static_cast<uint8_t>(1u << face);
                 });
    return faces;
}

BrickTables makeBrickTables(const SolidGrid& grid, std::span<const uint8_t> faces)
{
    BrickTables tables;
    for (const MaskedCells& group : grid.groups)
        tables.groups.push_back(
            {static_cast<uint32_t>(group.mask), static_cast<uint32_t>(group.mask >> 32), group.first});
    for (const MaskedCells& solid : grid.bricks)
    {
        formats::BrickRecord brick{};
        brick.voxel_mask_low = static_cast<uint32_t>(solid.mask);
        brick.voxel_mask_high = static_cast<uint32_t>(solid.mask >> 32);
        brick.first_voxel = solid.first;
        brick.first_face = static_cast<uint32_t>(tables.albedo.size());
        for (uint32_t face = 0; face < kFaces; ++face)
        {
            uint32_t voxel = solid.first;
            for (uint64_t rest = solid.mask; rest != 0; rest &= rest - 1, ++voxel)
            {
                if ((faces[voxel] >> face & 1) == 0)
                    continue;
                const auto bit = static_cast<uint32_t>(std::countr_zero(rest));
                brick.face_masks[2 * face + bit / 32] |= 1u << bit % 32;
                const SolidVoxel& look = grid.voxels[voxel];
                tables.albedo.push_back(look.albedo[face]);
                tables.normals.push_back(look.normal[face]);
            }
        }
        tables.bricks.push_back(brick);
    }
    for (const SolidVoxel& voxel : grid.voxels)
        tables.opacity.push_back(voxel.opacity);
    tables.emission.assign(tables.albedo.size(), 0);
    tables.lighting = tables.emission;
    tables.grid = {grid.frame.origin,
                   grid.frame.voxel_size,
                   {grid.frame.voxels[0], grid.frame.voxels[1], grid.frame.voxels[2]},
                   static_cast<uint32_t>(tables.groups.size()),
                   static_cast<uint32_t>(tables.bricks.size()),
                   static_cast<uint32_t>(tables.opacity.size()),
                   static_cast<uint32_t>(tables.albedo.size()),
                   0};
    return tables;
}

} // namespace hearth::bricks
