// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/grid/face_locations.h"

#include "cook/bricks/grid/brick_tables.h"

#include <bit>

namespace hearth::bricks
{

using namespace shared;

namespace
{

uint16_t voxelCoordinate(uint32_t group, uint32_t brick, uint32_t voxel)
{
    return static_cast<uint16_t>(kGroupVoxels * group + kBrickVoxels * (brick & 3) + (voxel & 3));
}

} // namespace

std::vector<FaceLocation> faceLocations(const BrickMasks& masks)
{
    std::vector<FaceLocation> places;
    const uint32_t groups_x = brickGroupsAlongAxis(masks.grid.voxels_x),
                   groups_y = brickGroupsAlongAxis(masks.grid.voxels_y);
    for (uint32_t g = 0; g < masks.groups.size(); ++g)
    {
        const BrickGroup& group = masks.groups[g];
        uint32_t brick = group.first_brick;
        for (uint64_t bricks = joinMask(group.brick_mask_low, group.brick_mask_high); bricks != 0;
             bricks &= bricks - 1, ++brick)
        {
            const auto b = static_cast<uint32_t>(std::countr_zero(bricks));
            const Brick& record = masks.bricks[brick];
            for (uint16_t side = 0; side < kVoxelFaces; ++side)
                for (uint64_t voxels = joinMask(record.face_masks[2 * side], record.face_masks[2 * side + 1]);
                     voxels != 0; voxels &= voxels - 1)
                {
                    const auto v = static_cast<uint32_t>(std::countr_zero(voxels));
                    places.push_back({voxelCoordinate(g % groups_x, b, v),
                                      voxelCoordinate(g / groups_x % groups_y, b >> 2, v >> 2),
                                      voxelCoordinate(g / groups_x / groups_y, b >> 4, v >> 4), side});
                }
        }
    }
    return places;
}

} // namespace hearth::bricks
