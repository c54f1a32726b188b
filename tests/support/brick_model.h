// Grids of bricks made by hand, for tests and benches: the tables of any set of voxels.
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

/// What the chunks of a grid hold.
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

    shared::BrickMasks masks() const { return {formats::toBrickGrid(grid), groups, bricks}; }
};

/// The grid whose voxel (x, y, z) is solid where `solid(x, y, z)` says so, opaque, white and dark, with a face wherever the
/// neighbour is not solid, whose normal looks along it. From (0, 0, 0), voxels of 1 m.
BrickModel brickModel(std::array<uint32_t, 3> voxels,
                      const std::function<bool(uint32_t, uint32_t, uint32_t)>& solid);

} // namespace hearth::test
