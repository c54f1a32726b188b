// Lists the tiles of each material, rows from top to bottom. One workgroup per material.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/records.h"
#include "runtime/shaders/draw/tiles.glsl"
#include "runtime/shaders/cull/scan.glsl"

layout(local_size_x = kScanThreads) in;

layout(set = kSetTables, binding = kTableTileDraws, std430) readonly buffer TileDraws { TileDraw tile_draws[]; };
layout(set = kSetTiles, binding = kTilesMaterials, std430) readonly buffer TileMaterials { uint tile_materials[]; };
layout(set = kSetTiles, binding = kTilesLists, std430) writeonly buffer TileLists { uint tile_lists[]; };

// True if a tile has the material. Binary search: the materials of a tile are sorted.
bool tileHas(uint tile, uint material)
{
    uint at = tile * kMaterialsPerTile;
    for (uint step = kMaterialsPerTile / 2u; step > 0u; step >>= 1)
        if (tile_materials[at + step] <= material)
            at += step;
    return tile_materials[at] == material;
}

void main()
{
    uint material = gl_WorkGroupID.y * kMaxDispatchX + gl_WorkGroupID.x;
    if (material >= push.draw_count)
        return;
    TileDraw draw = tile_draws[material];
    if (draw.instance_count == 0u || draw.first_vertex == 0u)
        return;
    uint entry = draw.first_vertex / kTileVertices;
    uint end = entry + draw.instance_count;
    uint row = materialTiles(push.width);
    for (uint first = 0u; entry < end; first += kScanThreads)
    {
        uint tile = first + gl_LocalInvocationIndex;
        bool has = tile < row * materialTiles(push.height) && tileHas(tile, material);
        uint total;
        uint rank = exclusiveScan(has ? 1u : 0u, total);
        if (has)
            tile_lists[entry + rank] = (tile % row) | (tile / row) << 16;
        entry += total;
    }
}
