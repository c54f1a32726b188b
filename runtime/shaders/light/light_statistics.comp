// Counts the lights that the pixels of a frame evaluate, and those whose light reaches them. One thread per
// pixel, behind a frame that kept its visibility buffer.
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
#define HEARTH_LIGHTING_SET kSetSceneLights
#define HEARTH_LIGHTING_BINDING kLightsBuffer
#include "runtime/shaders/scene/light_block.glsl"
#include "runtime/shaders/shade/light_irradiance.glsl"
#include "runtime/shaders/shade/light_list.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = kSetPixels, binding = kPixelsVisibility) uniform usampler2D visibility;
layout(set = kSetSceneLights, binding = kLightsBuffer, std430) buffer LightCounts { uint light_counts[]; };

vec3 reflectedShare(Light light, vec3 from_lamp)
{
    return vec3(0.0);
}

// Add to a number of two words.
void add(uint word, uint count)
{
    uint before = atomicAdd(light_counts[word], count);
    if (before + count < before)
        atomicAdd(light_counts[word + 1u], 1u);
}

void main()
{
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x >= uint(view.width) || pixel.y >= uint(view.height))
        return;
    uint id = texelFetch(visibility, ivec2(pixel), 0).x;
    if (id == kVisibilitySky)
        return;
    vec2 place = vec2(pixel) + 0.5;
    Surface s = resolveSurface(id, place);
    LightListing listing = findLights(s.position, place, s.slot_number);
    uint reaching = 0u;
    for (uint i = 0u; i < listing.count; ++i)
    {
        vec3 to_light;
        vec3 irradiance = lightIrradiance(lights[listedLight(listing, i)], s.position, to_light);
        reaching += any(greaterThan(irradiance, vec3(0.0))) ? 1u : 0u;
    }
    uint first = lighting.first_list_word;
    atomicAdd(light_counts[first + kCountPixels], 1u);
    atomicMax(light_counts[first + kCountLongest], listing.count);
    add(first + kCountEvaluated, listing.count);
    add(first + kCountReaching, reaching);
}
