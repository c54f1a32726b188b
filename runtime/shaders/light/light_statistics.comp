// Counts the lights that the pixels of a frame evaluate, and those whose light reaches them. One thread per
// pixel, behind a frame that kept its visibility buffer.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/light_volume.h"
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

// 1 if the light is not 0 at a point relative to the eye.
uint reaches(Light light, vec3 position)
{
    vec3 to_light;
    return any(greaterThan(lightIrradiance(light, position, to_light), vec3(0.0))) ? 1u : 0u;
}

// True if a pixel evaluates a ranged light outside of its list: one in whose volume it is, or that its bits
// name.
bool isDrawn(uint row, uint number, vec3 position)
{
    if (kLightList != kLightListVolumes && (kLightList != kLightListBits || number >= kMarkedLights))
        return false;
    vec3 place = vec3(dot(lighting.grid.right, position), dot(lighting.grid.down, position),
                      dot(lighting.grid.forward, position));
    CellLight light = makeCellLight(lighting.grid, lights[row]);
    return kLightList == kLightListVolumes ? isInLightVolume(light, place) : mayReachPoint(light, place);
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
    uint first = lighting.first_list_word;
    LightListing listing = findLights(s.position, place, s.slot_number);
    uint evaluated = 0u;
    uint reaching = 0u;
    for (uint i = 0u; i < listing.count; ++i)
    {
        uint number = listedPlace(listing, i);
        if (kLightList == kLightListBits && number >= listing.unranged_count && number < listing.unranged_count + kMarkedLights)
            continue;
        ++evaluated;
        reaching += reaches(lights[frameLight(number)], s.position);
    }
    uint ranged = light_words[first + kCountRanged];
    for (uint i = 0u; i < ranged && kLightList >= kLightListVolumes; ++i)
    {
        uint row = frameLight(listing.unranged_count + i);
        if (!isDrawn(row, i, s.position))
            continue;
        ++evaluated;
        reaching += reaches(lights[row], s.position);
    }
    atomicAdd(light_counts[first + kCountPixels], 1u);
    atomicMax(light_counts[first + kCountLongest], evaluated);
    add(first + kCountEvaluated, evaluated);
    add(first + kCountReaching, reaching);
}
