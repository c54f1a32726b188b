// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/grid/brick_tables.h"

namespace hearth::bricks
{

using namespace formats;

BrickBytes computeBrickBytes(uint64_t groups, uint64_t bricks, uint64_t voxels, uint64_t faces)
{
    return {groups * sizeof(BrickGroupRecord), bricks * sizeof(BrickRecord), voxels * sizeof(uint8_t),
            faces * sizeof(uint32_t),          faces * sizeof(uint16_t),     faces * sizeof(uint32_t),
            faces * sizeof(uint32_t)};
}

Status writeTables(ContainerWriter& writer, const BrickTables& tables)
{
    HEARTH_TRY(writer.addRecords<BrickGridRecord>(kChunkBrickGrid, {&tables.grid, 1}));
    HEARTH_TRY(writer.addRecords<BrickGroupRecord>(kChunkBrickGroups, tables.groups));
    HEARTH_TRY(writer.addRecords<BrickRecord>(kChunkBricks, tables.bricks));
    HEARTH_TRY(writer.addRecords<uint8_t>(kChunkBrickOpacity, tables.opacity));
    HEARTH_TRY(writer.addRecords<uint32_t>(kChunkBrickAlbedo, tables.albedo));
    HEARTH_TRY(writer.addRecords<uint16_t>(kChunkBrickNormals, tables.normals));
    HEARTH_TRY(writer.addRecords<uint32_t>(kChunkBrickEmission, tables.emission));
    HEARTH_TRY(writer.addRecords<uint32_t>(kChunkBrickLighting, tables.lighting));
    return writer.addRecords<ReflectorRecord>(kChunkReflectors, tables.reflectors);
}

} // namespace hearth::bricks
