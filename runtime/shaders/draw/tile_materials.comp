// Lists the materials visible in each tile, and counts the tiles of each material. One workgroup per tile.
// The lists are in rising order and the counts are sums, so nothing depends on the order of the threads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/records.h"
#include "runtime/shaders/draw/tiles.glsl"
#include "runtime/shaders/cull/scan.glsl"

layout(local_size_x = kScanThreads) in;

layout(set = kSetTables, binding = kTableVisible, std430) readonly buffer Visible { VisibleCluster visible[]; };
layout(set = kSetTables, binding = kTableDraws, std430) readonly buffer Draws { ClusterDraw cluster_draws[]; };
layout(set = kSetTables, binding = kTableTileDraws, std430) buffer TileDraws { TileDraw tile_draws[]; };
layout(set = kSetTiles, binding = kTilesVisibility) uniform usampler2D visibility;
layout(set = kSetTiles, binding = kTilesMaterials, std430) writeonly buffer TileMaterials { uint tile_materials[]; };

const uint kPixelsPerThread = kMaterialTilePixels * kMaterialTilePixels / kScanThreads;

shared uint visible_bits[kTileRoundMaterials / 32u]; // bit m: material first_material + m is visible

// Material id of a pixel. 0 is the sky.
uint materialAt(uvec2 pixel)
{
    if (pixel.x >= push.width || pixel.y >= push.height)
        return kNoTileMaterial;
    uint id = texelFetch(visibility, ivec2(pixel), 0).x;
    return id == kVisibilitySky ? 0u : cluster_draws[visible[id >> kTriangleBits].cluster].material;
}

// Append the materials of this thread's word after the `rank` materials of the words before.
void appendMaterials(uint word, uint first_material, uint tile, uint rank)
{
    for (; word != 0u; word &= word - 1u, ++rank)
    {
        uint material = first_material + uint(findLSB(word));
        if (rank < kMaterialsPerTile)
        {
            tile_materials[tile * kMaterialsPerTile + rank] = material;
            atomicAdd(tile_draws[material].instance_count, 1u);
        }
        else
            atomicOr(tile_draws[material].instance_count, kFullScreenBit);
    }
}

void main()
{
    uint lane = gl_LocalInvocationIndex;
    uint tile = tileIndex(gl_WorkGroupID.xy);
    uvec2 origin = gl_WorkGroupID.xy * kMaterialTilePixels;
    uint materials[kPixelsPerThread];
    for (uint i = 0u; i < kPixelsPerThread; ++i)
    {
        uint pixel = i * kScanThreads + lane;
        materials[i] = materialAt(origin + uvec2(pixel % kMaterialTilePixels, pixel / kMaterialTilePixels));
    }

    uint found = 0u;
    for (uint first = 0u; first < push.draw_count; first += kTileRoundMaterials)
    {
        visible_bits[lane] = 0u;
        barrier();
        for (uint i = 0u; i < kPixelsPerThread; ++i)
        {
            // neighbours mostly have the same material: one atomic for all of them
            uint bit = materials[i] - first;
            if (bit < kTileRoundMaterials && (i == 0u || materials[i] != materials[i - 1u]))
                atomicOr(visible_bits[bit >> 5], 1u << (bit & 31u));
        }
        barrier();
        uint word = visible_bits[lane];
        uint total;
        uint rank = exclusiveScan(uint(bitCount(word)), total);
        appendMaterials(word, first + lane * 32u, tile, found + rank);
        found += total;
    }
    if (lane >= found && lane < kMaterialsPerTile)
        tile_materials[tile * kMaterialsPerTile + lane] = kNoTileMaterial;
}
