// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/voxel_model.h"

#include "formats/codecs/vertex_codec.h"
#include "formats/gpu_shared/brick_codes.h"

namespace hearth::bricks
{

using namespace shared;

namespace
{

void setBit(uint32_t& low, uint32_t& high, uint32_t bit)
{
    (bit < 32 ? low : high) |= 1u << (bit & 31);
}

Float3 getAxis(uint32_t face)
{
    Float3 axis;
    axis[static_cast<int>(face / 2)] = face % 2 == 1 ? 1.0f : -1.0f;
    return axis;
}

} // namespace

uint32_t faceAt(const BrickTables& tables, uint32_t x, uint32_t y, uint32_t z, uint32_t face)
{
    const uint32_t groups_x = brickGroupsAlongAxis(tables.grid.voxels[0]),
                   groups_y = brickGroupsAlongAxis(tables.grid.voxels[1]);
    const BrickGroup& group = tables.groups[x / 16 + groups_x * (y / 16 + groups_y * (z / 16))];
    const uint32_t bit = brickBit(x / 4, y / 4, z / 4);
    if (!maskHas(group.brick_mask_low, group.brick_mask_high, bit))
        return kNoFace;
    const Brick& brick =
        tables.bricks[group.first_brick + maskCountBelow(group.brick_mask_low, group.brick_mask_high, bit)];
    return brickFace(brick, brickBit(x, y, z), face);
}

void VoxelModel::fill(std::array<uint32_t, 3> low, std::array<uint32_t, 3> high, const Voxel& voxel)
{
    for (uint32_t z = low[2]; z < high[2]; ++z)
        for (uint32_t y = low[1]; y < high[1]; ++y)
            for (uint32_t x = low[0]; x < high[0]; ++x)
                set(x, y, z, voxel);
}

void VoxelModel::shell(std::array<uint32_t, 3> low, std::array<uint32_t, 3> high, const Voxel& voxel)
{
    for (uint32_t z = low[2]; z < high[2]; ++z)
        for (uint32_t y = low[1]; y < high[1]; ++y)
            for (uint32_t x = low[0]; x < high[0]; ++x)
                if (x == low[0] || y == low[1] || z == low[2] || x + 1 == high[0] || y + 1 == high[1] ||
                    z + 1 == high[2])
                    set(x, y, z, voxel);
}

const Voxel* VoxelModel::at(int64_t x, int64_t y, int64_t z) const
{
    const auto found =
        voxels_.find({static_cast<uint32_t>(z), static_cast<uint32_t>(y), static_cast<uint32_t>(x)});
    return found == voxels_.end() ? nullptr : &found->second;
}

BrickTables VoxelModel::build() const
{
    BrickTables tables;
    tables.grid = grid_;
    const uint32_t groups[3] = {brickGroupsAlongAxis(grid_.voxels[0]), brickGroupsAlongAxis(grid_.voxels[1]),
                                brickGroupsAlongAxis(grid_.voxels[2])};
    // sorted by group, then by the brick's bit, then by the voxel's bit: the order of the tables
    std::map<std::pair<uint32_t, uint32_t>, std::map<uint32_t, Place>> bricks;
    for (const auto& [place, voxel] : voxels_)
    {
        const auto [z, y, x] = place;
        const uint32_t group = x / 16 + groups[0] * (y / 16 + groups[1] * (z / 16));
        bricks[{group, brickBit(x / 4, y / 4, z / 4)}][brickBit(x, y, z)] = place;
    }
    tables.groups.resize(size_t{groups[0]} * groups[1] * groups[2]);
    for (const auto& [key, places] : bricks)
    {
        setBit(tables.groups[key.first].brick_mask_low, tables.groups[key.first].brick_mask_high, key.second);
        Brick brick{};
        brick.first_voxel = static_cast<uint32_t>(tables.opacity.size());
        brick.first_face = static_cast<uint32_t>(tables.albedo.size());
        for (const auto& [bit, place] : places)
        {
            setBit(brick.voxel_mask_low, brick.voxel_mask_high, bit);
            tables.opacity.push_back(voxels_.at(place).opacity);
        }
        for (uint32_t face = 0; face < kVoxelFaces; ++face)
            for (const auto& [bit, place] : places)
            {
                const Float3 axis = getAxis(face);
                const Voxel* beside =
                    at(place[2] + static_cast<int64_t>(axis.x), place[1] + static_cast<int64_t>(axis.y),
                       place[0] + static_cast<int64_t>(axis.z));
                if (beside != nullptr && beside->opacity == 255)
                    continue;
                setBit(brick.face_masks[2 * face], brick.face_masks[2 * face + 1], bit);
                const VoxelSide& side = voxels_.at(place).sides[face];
                const bool has_normal = dot(side.normal, side.normal) > 0;
                tables.albedo.push_back(encodeAlbedo(side.albedo) | encodeFaceDepth(side.depth));
                tables.normals.push_back(
                    static_cast<uint16_t>(formats::NormalCode<8>::encode(has_normal ? side.normal : axis)));
                tables.emission.push_back(encodeRadiance(side.emission));
                tables.lighting.push_back(0);
            }
        tables.bricks.push_back(brick);
    }
    uint32_t first = 0;
    for (BrickGroup& group : tables.groups)
    {
        group.first_brick = first;
        first += maskCount(group.brick_mask_low, group.brick_mask_high);
    }
    tables.grid.group_count = static_cast<uint32_t>(tables.groups.size());
    tables.grid.brick_count = static_cast<uint32_t>(tables.bricks.size());
    tables.grid.solid_count = static_cast<uint32_t>(tables.opacity.size());
    tables.grid.face_count = static_cast<uint32_t>(tables.albedo.size());
    return tables;
}

} // namespace hearth::bricks
