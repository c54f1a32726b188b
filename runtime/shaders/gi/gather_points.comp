// Chooses the point of each tile at which light is gathered (GI) for the whole tile. One thread per tile.
// Takes the middle pixel, or one of four pixels around it if the middle one is sky.
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

layout(local_size_x = kGatherGroupTiles, local_size_y = kGatherGroupTiles) in;

layout(set = kSetGatherPoint, binding = kGatherPointVisibility) uniform usampler2D visibility;
layout(set = kSetGatherPoint, binding = kGatherPointPoints, std430) writeonly buffer GatherPoints { GatherPoint gather_points[]; };

const uint kCandidates = 5u;
const uvec2 kCandidatePixels[kCandidates] = uvec2[](uvec2(4u, 4u), uvec2(2u, 2u), uvec2(6u, 2u), uvec2(2u, 6u), uvec2(6u, 6u));

void main()
{
    uvec2 tile = gl_GlobalInvocationID.xy;
    uvec2 size = uvec2(view.width, view.height);
    uvec2 tiles = uvec2(gatherTiles(size.x), gatherTiles(size.y));
    if (any(greaterThanEqual(tile, tiles)))
        return;
    uint id = kVisibilitySky;
    uvec2 pixel = uvec2(0u);
    for (uint i = 0u; i < kCandidates && id == kVisibilitySky; ++i)
    {
        pixel = min(tile * kGatherTilePixels + kCandidatePixels[i], size - 1u);
        id = texelFetch(visibility, ivec2(pixel), 0).x;
    }
    GatherPoint point;
    point.position = vec3(0.0);
    point.count = 0.0;
    point.normal = vec3(0.0, 1.0, 0.0);
    point.sky = 0.0;
    point.mean = vec3(0.0);
    point.has_surface = id != kVisibilitySky ? 1.0 : 0.0;
    point.red = point.green = point.blue = vec4(0.0);
    point.wide = vec3(0.0);
    point.reserved = 0.0;
    if (id != kVisibilitySky)
    {
        Surface s = resolveSurface(id, vec2(pixel) + 0.5);
        point.position = s.position;
        point.normal = smoothNormal(s) * (s.front ? 1.0 : -1.0);
    }
    gather_points[tile.y * tiles.x + tile.x] = point;
}
