// Chooses the point of each tile at which light is gathered (GI) for the whole tile. One thread per tile.
// Takes the middle pixel, or one of four pixels around it if the middle one is sky. Small forms between the
// middle pixels would get the light of what is behind them: every other tile stands for one, where a
// neighbour stands for its middle pixel.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/gather.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/scene/material.glsl"
#include "runtime/shaders/scene/surface_point.glsl"
#include "runtime/shaders/scene/resolve.glsl"
#include "runtime/shaders/gi/gather_similarity.glsl"

layout(local_size_x = kGatherGroupTiles, local_size_y = kGatherGroupTiles) in;

layout(set = kSetGatherPoint, binding = kGatherPointVisibility) uniform usampler2D visibility;
layout(set = kSetGatherPoint, binding = kGatherPointPoints, std430) writeonly buffer GatherPoints { GatherPoint gather_points[]; };

const uint kCandidates = 5u;
const uvec2 kCandidatePixels[kCandidates] = uvec2[](uvec2(4u, 4u), uvec2(2u, 2u), uvec2(6u, 2u), uvec2(2u, 6u), uvec2(6u, 6u));

// Similarity below which a point does not stand for a surface, and above which it does.
const float kUnlike = 0.1;
const float kAlike = 0.5;

struct TilePoint
{
    vec3 position; // relative to the eye
    vec3 normal;   // unit, towards the visible side
    bool has_surface;
};

TilePoint pointAt(uvec2 pixel)
{
    TilePoint point = TilePoint(vec3(0.0), vec3(0.0, 1.0, 0.0), false);
    uint id = texelFetch(visibility, ivec2(pixel), 0).x;
    if (id == kVisibilitySky)
        return point;
    Surface s = resolveSurface(id, vec2(pixel) + 0.5);
    point.position = s.position;
    point.normal = smoothNormal(s) * (s.front ? 1.0 : -1.0);
    point.has_surface = true;
    return point;
}

uvec2 tilePixel(uvec2 tile, uvec2 offset) { return min(tile * kGatherTilePixels + offset, uvec2(view.width, view.height) - 1u); }

// Return the middle pixel's point, or one of four around it if the middle one is sky.
TilePoint middlePoint(uvec2 tile)
{
    uvec2 pixel = tilePixel(tile, kCandidatePixels[0]);
    for (uint i = 0u; i < kCandidates; ++i)
    {
        pixel = tilePixel(tile, kCandidatePixels[i]);
        if (texelFetch(visibility, ivec2(pixel), 0).x != kVisibilitySky)
            break;
    }
    return pointAt(pixel);
}

// Return how well a tile's point stands for another point.
float similarity(TilePoint tile, TilePoint other)
{
    if (!tile.has_surface)
        return 0.0;
    return gatherSimilarity(tile.normal, dot(tile.normal, tile.position), other.position, other.normal,
                            length(other.position) * float(kGatherTilePixels) / view.lod_scale);
}

// Return the point of a small form that no point around stands for, if a neighbour stands for the middle
// point; else the middle point.
TilePoint smallFormPoint(uvec2 tile, uvec2 tiles, TilePoint middle)
{
    TilePoint around[4];
    for (uint i = 0u; i < 4u; ++i)
    {
        ivec2 step = ivec2(i & 1u, ~i & 1u) * (i < 2u ? 1 : -1);
        around[i] = middlePoint(uvec2(clamp(ivec2(tile) + step, ivec2(0), ivec2(tiles) - 1)));
    }
    float known = 0.0;
    for (uint i = 0u; i < 4u; ++i)
        known = max(known, similarity(around[i], middle));
    if (known < kAlike)
        return middle;
    TilePoint chosen = middle;
    float lowest = kUnlike;
    for (uint i = 0u; i < kGatherTilePixels; ++i)
    {
        // in each row and column once: a bar through the tile is met
        TilePoint point = pointAt(tilePixel(tile, uvec2(i, (3u * i + 3u) % kGatherTilePixels)));
        if (!point.has_surface)
            continue;
        float alike = similarity(middle, point);
        for (uint j = 0u; j < 4u; ++j)
            alike = max(alike, similarity(around[j], point));
        if (alike < lowest)
        {
            lowest = alike;
            chosen = point;
        }
    }
    return chosen;
}

void main()
{
    uvec2 tile = gl_GlobalInvocationID.xy;
    uvec2 tiles = uvec2(gatherTiles(uint(view.width)), gatherTiles(uint(view.height)));
    if (any(greaterThanEqual(tile, tiles)))
        return;
    TilePoint chosen = middlePoint(tile);
    // every other tile, as on a chessboard: of the four tiles of a pixel two keep their middle points
    if (chosen.has_surface && ((tile.x + tile.y) & 1u) == 0u)
        chosen = smallFormPoint(tile, tiles, chosen);
    GatherPoint point;
    point.position = chosen.position;
    point.count = 0.0;
    point.normal = chosen.normal;
    point.sky = 0.0;
    point.mean = vec3(0.0);
    point.has_surface = chosen.has_surface ? 1.0 : 0.0;
    point.red = point.green = point.blue = vec4(0.0);
    point.wide = vec3(0.0);
    point.reserved = 0.0;
    gather_points[tile.y * tiles.x + tile.x] = point;
}
