// Finds what the pixels of a frame need lists of lights for, behind its visibility buffer: the depths of
// their tile, or their cell of the light grid. A workgroup has a tile. Points are reconstructed as shading
// does: a depth buffer is off by much more where a surface is seen at a grazing angle.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/scene/material.glsl"
#include "runtime/shaders/scene/surface_point.glsl"
#include "runtime/shaders/scene/resolve.glsl"
#define HEARTH_LIGHTS_SET kSetSceneLights
#include "runtime/shaders/light/light_buffer.glsl"

layout(constant_id = kConstantLightList) const uint kLightList = kLightListCells;

const uvec2 kGroupPixels = uvec2(16u, 8u);
layout(local_size_x = kGroupPixels.x, local_size_y = kGroupPixels.y) in;

layout(set = kSetPixels, binding = kPixelsVisibility) uniform usampler2D visibility;

// bits of depths, which rise as those do
shared uint least, greatest;

void markPixel(uvec2 pixel)
{
    uint id = texelFetch(visibility, ivec2(pixel), 0).x;
    if (id == kVisibilitySky)
        return;
    vec2 place = vec2(pixel) + 0.5;
    float depth = max(dot(view.clip_w.xyz, resolveSurface(id, place).position), 0.0);
    if (kLightList == kLightListTiles)
    {
        atomicMin(least, floatBitsToUint(depth));
        atomicMax(greatest, floatBitsToUint(depth));
        return;
    }
    LightCascade cascade = lighting.cascades[lightCascadeAt(depth)];
    atomicMin(light_words[lighting.first_cell_word + lightCellAt(cascade, place.x, place.y, depth)], 0u);
}

void main()
{
    if (gl_LocalInvocationIndex == 0u)
    {
        least = floatBitsToUint(kMaxFiniteError);
        greatest = 0u;
    }
    barrier();
    LightCascade tiles = lighting.tiles;
    uint side = uint(1.0 / tiles.cells_per_pixel);
    uvec2 begin = gl_WorkGroupID.xy * side;
    uvec2 end = min(begin + side, uvec2(view.width, view.height));
    for (uint y = begin.y + gl_LocalInvocationID.y; y < end.y; y += kGroupPixels.y)
        for (uint x = begin.x + gl_LocalInvocationID.x; x < end.x; x += kGroupPixels.x)
            markPixel(uvec2(x, y));
    barrier();
    if (kLightList != kLightListTiles || gl_LocalInvocationIndex != 0u)
        return;
    uint depths = lighting.first_cell_word + tileDepthWord(gl_WorkGroupID.y * tiles.columns + gl_WorkGroupID.x);
    light_words[depths] = least;
    light_words[depths + 1u] = greatest;
}
