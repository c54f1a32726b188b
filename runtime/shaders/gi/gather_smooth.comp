// Filters the gathered light (GI) over tiles that show the same surface, and encodes it for shading. One
// thread per tile. The history for the next frame stays unfiltered.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/brick_codes.h"
#include "formats/gpu_shared/gather.h"
#include "runtime/shaders/gi/gather_encoding.glsl"

layout(local_size_x = kGatherGroupTiles, local_size_y = kGatherGroupTiles) in;

layout(set = kSetGatherSmooth, binding = kGatherView, std140) uniform Gather { GatherView gather; };
layout(set = kSetGatherSmooth, binding = kGatherPoints, std430) readonly buffer GatherPoints { GatherPoint gather_points[]; };
layout(set = kSetGatherSmooth, binding = kGatherTexels, rgba32ui) uniform writeonly uimage2D gather_texels;

// Weight of a neighbour tile's point: high if both lie on the same surface. Never quite 0, so that enclosed
// points borrow from their neighbours.
float surfaceSimilarity(GatherPoint point, GatherPoint other)
{
    float tile = gatherTileSize(gather, max(length(point.position), 1e-6));
    float off_plane = abs(dot(point.normal, other.position - point.position)) / tile;
    float alike = max(dot(point.normal, other.normal), 0.0);
    alike *= alike;
    alike *= alike;
    return alike * alike * max(1.0 - off_plane, 0.0) + 1e-5;
}

void main()
{
    uvec2 tile = gl_GlobalInvocationID.xy;
    if (tile.x >= gather.tiles_x || tile.y >= gather.tiles_y)
        return;
    GatherPoint point = gather_points[tile.y * gather.tiles_x + tile.x];
    GatherPoint sum = point;
    sum.mean = vec3(0.0);
    sum.sky = 0.0;
    sum.red = sum.green = sum.blue = vec4(0.0);
    sum.wide = vec3(0.0);
    float weights = 0.0;
    ivec2 last = ivec2(gather.tiles_x, gather.tiles_y) - 1;
    for (int y = -kGatherFilterRadius; y <= kGatherFilterRadius; ++y)
        for (int x = -kGatherFilterRadius; x <= kGatherFilterRadius; ++x)
        {
            ivec2 at = ivec2(tile) + ivec2(x, y);
            if (any(notEqual(at, clamp(at, ivec2(0), last))))
                continue;
            GatherPoint other = gather_points[uint(at.y) * gather.tiles_x + uint(at.x)];
            if (other.count == 0.0)
                continue;
            float reach = float(kGatherFilterRadius + 1);
            float near = max(1.0 - float(x * x + y * y) / (reach * reach), 0.0);
            float weight = near * near * surfaceSimilarity(point, other);
            sum.mean += other.mean * weight;
            sum.sky += other.sky * weight;
            sum.red += other.red * weight;
            sum.green += other.green * weight;
            sum.blue += other.blue * weight;
            sum.wide += other.wide * weight;
            weights += weight;
        }
    if (point.has_surface == 0.0 || weights == 0.0)
        sum.has_surface = 0.0;
    else
    {
        float scale = 1.0 / weights;
        sum.mean *= scale;
        sum.sky *= scale;
        sum.red *= scale;
        sum.green *= scale;
        sum.blue *= scale;
        sum.wide *= scale;
    }
    GatherTexels texels = encodeGatherTexels(sum);
    imageStore(gather_texels, ivec2(tile.x * 2u, tile.y), texels.mean);
    imageStore(gather_texels, ivec2(tile.x * 2u + 1u, tile.y), texels.lobes);
}
