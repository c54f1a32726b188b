// Turns the number of tiles of each material into the offset of its list: a prefix sum over all materials in
// one workgroup. Also completes the indirect draws.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "runtime/shaders/draw/tiles.glsl"
#include "runtime/shaders/cull/scan.glsl"

layout(local_size_x = kScanThreads) in;

layout(set = kSetTables, binding = kTableTileDraws, std430) buffer TileDraws { TileDraw tile_draws[]; };

void main()
{
    uint end = kFirstTileEntry;
    for (uint first = 0u; first < push.draw_count; first += kScanThreads)
    {
        uint i = first + gl_LocalInvocationIndex;
        uint count = i < push.draw_count ? tile_draws[i].instance_count : 0u;
        bool whole = (count & kFullScreenBit) != 0u;
        uint total;
        uint entry = end + exclusiveScan(whole ? 0u : count, total);
        if (i < push.draw_count)
            tile_draws[i] = whole ? TileDraw(3u, 1u, 0u, 0u) : TileDraw(kTileVertices, count, kTileVertices * entry, 0u);
        end += total;
    }
}
