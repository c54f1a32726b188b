// Gathers indirect light (GI) by tracing rays through the bricks. kGatherRays threads per point; each thread
// traces one ray of the hemisphere and one of a specular lobe. Sums are taken in the order of the rays.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "runtime/shaders/scene/bricks.glsl"
#include "formats/gpu_shared/gather.h"
#include "formats/gpu_shared/gather_lobe.h"
#include "runtime/shaders/scene/to_eye.glsl"

layout(local_size_x = kGatherRays, local_size_y = kGatherGroupPoints) in; // kGatherRays is 2 kGatherLobeRays

layout(set = kSetGather, binding = kGatherView, std140) uniform Gather { GatherView gather; };
layout(set = kSetGather, binding = kGatherPoints, std430) buffer GatherPoints { GatherPoint gather_points[]; };
layout(set = kSetGather, binding = kGatherHistory, std430) readonly buffer GatherBefore { GatherPoint points_before[]; };

// Radiance of a ray (rgb) and sky share (a); direction of the ray.
shared vec4 ray_light[kGatherGroupPoints][kGatherRays];
shared vec3 ray_direction[kGatherGroupPoints][kGatherRays];
// Weighted radiance and weight of the rays of the narrow lobe, then of the wide lobe.
shared vec4 lobe_light[kGatherGroupPoints][2u * kGatherLobeRays];
shared BrickStart starts[kGatherGroupPoints];

// Trace ray `index` of the two lobes. Returns its weighted radiance.
vec4 traceLobeRay(GatherPoint point, BrickStart start, uint index, uint seed)
{
    GatherLobeRay ray = gatherLobeRay(normalize(toEye(point.position)), point.normal, index < kGatherLobeRays ? kGatherSharpRoughness : kGatherWideRoughness,
                                      index % kGatherLobeRays * kGatherFrames + gather.frame % kGatherFrames,
                                      kGatherLobeRays * kGatherFrames, seed);
    if (ray.weight == 0.0)
        return vec4(0.0);
    vec3 origin = brickRayOrigin(brick_view.grid, start, ray.direction);
    return vec4(brickRayLight(brick_view.grid, sceneSky(), origin, ray.direction).radiance * ray.weight, ray.weight);
}

vec3 averageLobe(uint row, uint first)
{
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < kGatherLobeRays; ++i)
        sum += lobe_light[row][first + i];
    return sum.rgb / max(sum.a, 1e-6);
}

// Average the rays of this frame.
GatherPoint averageRays(GatherPoint point, uint row)
{
    for (uint i = 0u; i < kGatherRays; ++i)
    {
        vec4 light = ray_light[row][i];
        vec3 across = ray_direction[row][i] - point.normal * dot(point.normal, ray_direction[row][i]);
        point.mean += light.rgb;
        point.sky += light.a;
        point.red.xyz += across * light.r;
        point.green.xyz += across * light.g;
        point.blue.xyz += across * light.b;
    }
    float share = 1.0 / float(kGatherRays);
    vec3 sharp = averageLobe(row, 0u);
    point.mean *= share;
    float close = brickCloseFraction(starts[row], point.mean);
    share *= 1.0 - close;
    point.mean = mix(point.mean, starts[row].close, close);
    point.sky *= share;
    point.red *= share;
    point.green *= share;
    point.blue *= share;
    point.red.w = sharp.r;
    point.green.w = sharp.g;
    point.blue.w = sharp.b;
    point.wide = averageLobe(row, kGatherLobeRays);
    return point;
}

void add(inout GatherPoint sum, GatherPoint p, float weight)
{
    sum.count += p.count * weight;
    sum.mean += p.mean * weight;
    sum.sky += p.sky * weight;
    sum.red += p.red * weight;
    sum.green += p.green * weight;
    sum.blue += p.blue * weight;
    sum.wide += p.wide * weight;
}

// Return the weight that the result at `before` has for a point, both relative to the current eye. It is 1 if
// `before` lies in the plane of the point, within a quarter of a tile, and has the same normal.
float historyWeight(GatherPoint point, GatherPoint before, float reach)
{
    vec3 apart = before.position - gather.eye_step - point.position;
    float off_plane = abs(dot(point.normal, apart));
    float alike = dot(point.normal, before.normal);
    return before.count > 0.0 && off_plane < 0.25 * reach && alike > 0.9 && dot(apart, apart) < 4.0 * reach * reach ? 1.0 : 0.0;
}

// Reproject the result of the last frame at the position of a point. count 0: no history.
GatherPoint reprojectHistory(GatherPoint point)
{
    GatherPoint known = point;
    known.count = known.sky = 0.0;
    known.mean = vec3(0.0);
    known.red = known.green = known.blue = vec4(0.0);
    known.wide = vec3(0.0);
    if (gather.has_history == 0u)
        return known;
    vec3 position = point.position + gather.eye_step;
    float w = dot(gather.clip_w.xyz, position);
    if (w < view.z_near)
        return known;
    vec2 ndc = vec2(dot(gather.clip_x.xyz, position), dot(gather.clip_y.xyz, position));
    ndc = gather.clip_w.w > 0.0 ? ndc + vec2(gather.clip_x.w, gather.clip_y.w) : ndc / w;
    // in texels of tiles: a point represents the middle of its tile
    vec2 at = (ndc * 0.5 + 0.5) * vec2(view.width, view.height) / float(kGatherTilePixels) - 0.5;
    // exactly the tile itself where nothing moves
    at = mix(at, round(at), lessThan(abs(at - round(at)), vec2(0.35)));
    vec2 low = floor(at);
    vec2 part = at - low;
    float reach = gatherTileSize(gather, max(w, view.z_near));
    float sum = 0.0;
    for (uint i = 0u; i < 4u; ++i)
    {
        vec2 corner = vec2(i & 1u, i >> 1);
        vec2 texel = low + corner;
        vec2 weights = mix(1.0 - part, part, corner);
        if (any(lessThan(texel, vec2(0.0))) || texel.x >= float(gather.tiles_x) || texel.y >= float(gather.tiles_y))
            continue;
        GatherPoint before = points_before[uint(texel.y) * gather.tiles_x + uint(texel.x)];
        float weight = weights.x * weights.y * historyWeight(point, before, reach);
        if (weight > 0.0)
            add(known, before, weight);
        sum += weight;
    }
    if (sum < 0.05)
    {
        known.count = 0.0;
        return known;
    }
    float scale = 1.0 / sum;
    known.count *= scale;
    known.mean *= scale;
    known.sky *= scale;
    known.red *= scale;
    known.green *= scale;
    known.blue *= scale;
    known.wide *= scale;
    return known;
}

// Blend the rays of this frame into the history, as the next of its frames.
GatherPoint accumulate(GatherPoint fresh, GatherPoint known)
{
    float count = min(known.count + 1.0, gather.history_frames);
    float share = 1.0 / count;
    float lobe_share = 1.0 / min(count, kGatherLobeHistoryFrames);
    fresh.mean = mix(known.mean, fresh.mean, share);
    fresh.sky = mix(known.sky, fresh.sky, share);
    vec4 shares = vec4(vec3(share), lobe_share);
    fresh.red = mix(known.red, fresh.red, shares);
    fresh.green = mix(known.green, fresh.green, shares);
    fresh.blue = mix(known.blue, fresh.blue, shares);
    fresh.wide = mix(known.wide, fresh.wide, lobe_share);
    fresh.count = count;
    return fresh;
}

// Index of a tile in its block, by the bits of a Bayer matrix, so that neighbours are far apart in the order.
uint orderInBlock(uvec2 tile)
{
    uint x = tile.x & 3u;
    uint y = tile.y & 3u;
    uint d = x ^ y;
    return (d & 1u) << 3 | (y & 1u) << 2 | (d & 2u) | y >> 1;
}

void main()
{
    uvec2 tile = uvec2(gl_WorkGroupID.x * kGatherGroupPoints + gl_LocalInvocationID.y, gl_WorkGroupID.y);
    uint row = gl_LocalInvocationID.y;
    uint index = gl_LocalInvocationID.x;
    bool inside = tile.x < gather.tiles_x;
    uint number = tile.y * gather.tiles_x + tile.x;
    GatherPoint point;
    point.has_surface = 0.0;
    if (inside)
        point = gather_points[number];
    bool seen = point.has_surface > 0.0;
    if (seen && index == 0u)
        starts[row] = brickVisibleStart(brick_view.grid, (gather.eye + point.position) / brick_view.grid.voxel_size, point.normal,
                                        toEye(point.position) / brick_view.grid.voxel_size);
    barrier();
    bool open = seen && starts[row].is_interior == 0u;
    if (open)
    {
        BrickStart start = starts[row];
        uint seed = orderInBlock(tile) << 28;
        // takes every kGatherFrames-th ray of a spiral, so that one frame covers the hemisphere evenly and a
        // cycle of frames more finely; the upper bits of the seed rotate the spirals, so the tiles of a block
        // interleave
        vec3 direction = brickRayDirection(start.normal, index * kGatherFrames + gather.frame % kGatherFrames,
                                           kGatherRays * kGatherFrames, seed);
        ray_direction[row][index] = direction;
        BrickRayLight light = brickRayLight(brick_view.grid, sceneSky(), brickRayOrigin(brick_view.grid, start, direction), direction);
        ray_light[row][index] = vec4(light.radiance, light.sky);
        lobe_light[row][index] = traceLobeRay(point, start, index, seed);
    }
    barrier();
    if (open && index == 0u)
        gather_points[number] = accumulate(averageRays(point, row), reprojectHistory(point));
}
