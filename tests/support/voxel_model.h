// Builds bricks voxel by voxel, for tests that need no meshes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/brick_view.h"

#include <array>
#include <map>
#include <vector>

namespace hearth::bricks
{

struct VoxelSide
{
    Float3 albedo{0.5f, 0.5f, 0.5f};
    Float3 emission;
    Float3 normal;   ///< zero: the face's own normal
    float depth = 0; ///< of the surface behind the face, voxels
};

struct Voxel
{
    std::array<VoxelSide, 6> sides; ///< by face
    uint8_t opacity = 255;
};

/// Make a voxel that is the same on all sides.
inline Voxel makeVoxel(Float3 albedo, Float3 emission = {}, uint8_t opacity = 255)
{
    Voxel voxel;
    voxel.sides.fill({albedo, emission, {}});
    voxel.opacity = opacity;
    return voxel;
}

/// Return the index of a face in the tables, or kNoFace; slow.
uint32_t faceAt(const BrickTables& tables, uint32_t x, uint32_t y, uint32_t z, uint32_t face);

class VoxelModel
{
public:
    explicit VoxelModel(std::array<uint32_t, 3> voxels, float voxel_size = 1, Float3 origin = {})
        : grid_{.origin = origin,
                .voxel_size = voxel_size,
                .voxels = {voxels[0], voxels[1], voxels[2]},
                .group_count = 0,
                .brick_count = 0,
                .solid_count = 0,
                .face_count = 0,
                .reserved = 0}
    {
    }

    void set(uint32_t x, uint32_t y, uint32_t z, const Voxel& voxel) { voxels_[{z, y, x}] = voxel; }

    /// Set all voxels of [low, high).
    void fill(std::array<uint32_t, 3> low, std::array<uint32_t, 3> high, const Voxel& voxel);

    /// Set the walls of the box [low, high), one voxel thick.
    void shell(std::array<uint32_t, 3> low, std::array<uint32_t, 3> high, const Voxel& voxel);

    /// Add faces towards all cells that are empty, or solid but not opaque. Cells outside the grid are empty.
    BrickTables build() const;

private:
    using Place = std::array<uint32_t, 3>; ///< z, y, x

    const Voxel* at(int64_t x, int64_t y, int64_t z) const;

    formats::BrickGridRecord grid_;
    std::map<Place, Voxel> voxels_;
};

} // namespace hearth::bricks
