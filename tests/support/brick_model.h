// Brick grids made by hand, for tests and benches: the tables of any set of voxels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/brick_march.h"
#include "formats/records/bricks.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace hearth::test
{

/// Contents of a grid's chunks.
struct BrickModel
{
    formats::BrickGridRecord grid{};
    std::vector<formats::BrickGroupRecord> groups;
    std::vector<formats::BrickRecord> bricks;
    std::vector<uint8_t> opacity;
    std::vector<uint32_t> albedo;
    std::vector<uint16_t> normals;
    std::vector<uint32_t> emission;
    std::vector<uint32_t> lighting;
    std::vector<formats::ReflectorRecord> reflectors;

    shared::BrickMasks masks() const { return {formats::toBrickGrid(grid), groups, bricks}; }
};

/// Build the grid whose voxel (x, y, z) is solid where `solid(x, y, z)` is true. Voxels are opaque, white and
/// not emissive, with a face towards each neighbour that is not solid; the face's normal points at that
/// neighbour. Origin (0, 0, 0), voxels of 1 m.
BrickModel brickModel(std::array<uint32_t, 3> voxels,
                      const std::function<bool(uint32_t, uint32_t, uint32_t)>& solid);

} // namespace hearth::test
