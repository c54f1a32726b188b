// Brick grid in memory, in the layout of its chunks (FORMAT.md, "Bricks").
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/container/container_writer.h"
#include "formats/gpu_shared/brick_march.h"
#include "formats/records/bricks.h"

#include <vector>

namespace hearth::bricks
{

/// Return the mask of 64 bits whose halves records hold.
inline uint64_t joinMask(uint32_t low, uint32_t high)
{
    return uint64_t{high} << 32 | low;
}

struct BrickTables
{
    formats::BrickGridRecord grid{};
    std::vector<formats::BrickGroupRecord> groups;
    std::vector<formats::BrickRecord> bricks;
    std::vector<uint8_t> opacity; ///< one per solid voxel
    std::vector<uint32_t> albedo; ///< one per face, like the arrays below
    std::vector<uint16_t> normals;
    std::vector<uint32_t> emission;
    std::vector<uint32_t> lighting;                   ///< outgoing radiance, emission included
    std::vector<formats::ReflectorRecord> reflectors; ///< one for each light, or none

    /// Return the masks that ray marching reads.
    shared::BrickMasks masks() const { return {formats::toBrickGrid(grid), groups, bricks}; }
};

/// GPU memory of a voxel grid, bytes by table.
struct BrickBytes
{
    uint64_t groups = 0;
    uint64_t bricks = 0;
    uint64_t opacity = 0;
    uint64_t albedo = 0;
    uint64_t normals = 0;
    uint64_t emission = 0;
    uint64_t lighting = 0;

    uint64_t total() const { return groups + bricks + opacity + albedo + normals + emission + lighting; }
};

BrickBytes computeBrickBytes(uint64_t groups, uint64_t bricks, uint64_t voxels, uint64_t faces);

/// Add the chunks of a grid.
Status writeTables(formats::ContainerWriter& writer, const BrickTables& tables);

} // namespace hearth::bricks
