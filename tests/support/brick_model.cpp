// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/brick_model.h"

#include "formats/codecs/vertex_codec.h"
#include "formats/gpu_shared/brick_codes.h"

namespace hearth::test
{

using namespace formats;

namespace
{

using Solid = std::function<bool(uint32_t, uint32_t, uint32_t)>;
using Cell = std::array<uint32_t, 3>;

/// Sets bit (x, y, z) of a mask.
void setBit(uint32_t& low, uint32_t& high, Cell cell)
{
    const uint32_t bit = shared::brickBit(cell[0], cell[1], cell[2]);
    (bit < 32 ? low : high) |= 1u << (bit & 31u);
}

/// Call `use` for the 64 cells of `size` voxels from `first` on, in the order of their bits.
template <typename Use>
void forCells(Cell first, uint32_t size, Use use)
{
    for (uint32_t z = 0; z < 4; ++z)
        for (uint32_t y = 0; y < 4; ++y)
            for (uint32_t x = 0; x < 4; ++x)
                use(Cell{first[0] + x * size, first[1] + y * size, first[2] + z * size});
}

class Builder
{
public:
    Builder(Cell voxels, const Solid& solid) : solid_(solid)
    {
        model_.grid.voxel_size = 1;
        for (size_t axis = 0; axis < 3; ++axis)
            model_.grid.voxels[axis] = voxels[axis];
    }

    BrickModel build()
    {
        const auto& [nx, ny, nz] = model_.grid.voxels;
        for (uint32_t z = 0; z < nz; z += 16)
            for (uint32_t y = 0; y < ny; y += 16)
                for (uint32_t x = 0; x < nx; x += 16)
                    addGroup({x, y, z});
        model_.grid.group_count = static_cast<uint32_t>(model_.groups.size());
        model_.grid.brick_count = static_cast<uint32_t>(model_.bricks.size());
        model_.grid.solid_count = static_cast<uint32_t>(model_.opacity.size());
        model_.grid.face_count = static_cast<uint32_t>(model_.albedo.size());
        return std::move(model_);
    }

private:
    bool isSolid(Cell cell) const
    {
        const auto& voxels = model_.grid.voxels;
        return cell[0] < voxels[0] && cell[1] < voxels[1] && cell[2] < voxels[2] &&
               solid_(cell[0], cell[1], cell[2]);
    }

    void addGroup(Cell first)
    {
        BrickGroupRecord group{0, 0, static_cast<uint32_t>(model_.bricks.size())};
        forCells(first, 4,
                 [&](Cell brick)
                 {
                     if (addBrick(brick))
                         setBit(group.brick_mask_low, group.brick_mask_high,
                                {brick[0] / 4, brick[1] / 4, brick[2] / 4});
                 });
        model_.groups.push_back(group);
    }

    bool addBrick(Cell first)
    {
        BrickRecord brick{};
        brick.first_voxel = static_cast<uint32_t>(model_.opacity.size());
        brick.first_face = static_cast<uint32_t>(model_.albedo.size());
        forCells(first, 1,
                 [&](Cell voxel)
                 {
                     if (!isSolid(voxel))
                         return;
                     setBit(brick.voxel_mask_low, brick.voxel_mask_high, voxel);
                     model_.opacity.push_back(255);
                 });
        if (brick.first_voxel == model_.opacity.size())
            return false;
        for (uint32_t face = 0; face < shared::kVoxelFaces; ++face)
            forCells(first, 1, [&](Cell voxel) { addFace(brick, voxel, face); });
        model_.bricks.push_back(brick);
        return true;
    }

    void addFace(BrickRecord& brick, Cell voxel, uint32_t face)
    {
        Cell neighbour = voxel;
        neighbour[face / 2] += face % 2 != 0 ? 1u : ~0u; // -1 wraps around to a cell outside
        if (!isSolid(voxel) || isSolid(neighbour))
            return;
        setBit(brick.face_masks[2 * face], brick.face_masks[2 * face + 1], voxel);
        Float3 normal;
        normal[static_cast<int>(face / 2)] = face % 2 != 0 ? 1.0f : -1.0f;
        model_.albedo.push_back(shared::encodeAlbedo({1, 1, 1}));
        model_.normals.push_back(static_cast<uint16_t>(NormalCode<8>::encode(normal)));
        model_.emission.push_back(0);
        model_.lighting.push_back(0);
    }

    const Solid& solid_;
    BrickModel model_;
};

} // namespace

BrickModel brickModel(Cell voxels, const Solid& solid)
{
    return Builder(voxels, solid).build();
}

} // namespace hearth::test
