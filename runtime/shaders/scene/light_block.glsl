// Lights and sky of the frame, and the surroundings of instances. Needs formats/gpu_shared/shading.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/occluder_light.h"

#ifndef HEARTH_LIGHTING_SET
#define HEARTH_LIGHTING_SET kSetScene
#define HEARTH_LIGHTING_BINDING kSceneLighting
#endif

// one buffer in three views
layout(set = HEARTH_LIGHTING_SET, binding = HEARTH_LIGHTING_BINDING, std140) readonly buffer LightingBlock
{
    Lighting lighting;
    Light lights[];
};
layout(set = HEARTH_LIGHTING_SET, binding = HEARTH_LIGHTING_BINDING, std430) readonly buffer LightRows { uvec4 light_rows[]; };
layout(set = HEARTH_LIGHTING_SET, binding = HEARTH_LIGHTING_BINDING, std430) readonly buffer LightWords { uint light_words[]; };

const OccluderLight kNoOccluderLight = OccluderLight(vec4(0.0), vec4(0.0), vec4(0.0));

// Light that the occluders of an instance give back.
OccluderLight occluderLight(uint instance)
{
    if (lighting.surroundings_row == kNoSurroundings)
        return kNoOccluderLight;
    uint transfer = light_rows[lighting.surroundings_row + instance].x;
    if (transfer == kNoTransfer)
        return kNoOccluderLight;
    uint row = lighting.transfers_row + transfer * kOccluderLightRows;
    return OccluderLight(uintBitsToFloat(light_rows[row]), uintBitsToFloat(light_rows[row + 1u]),
                         uintBitsToFloat(light_rows[row + 2u]));
}

// Factor of the visibility of an instance's mesh: terms of the direction, and 1.
vec4 instanceVisibility(uint instance)
{
    if (lighting.surroundings_row == kNoSurroundings)
        return vec4(0.0, 0.0, 0.0, 1.0);
    uvec4 row = light_rows[lighting.surroundings_row + instance];
    return vec4(unpackHalf2x16(row.y), unpackHalf2x16(row.z));
}
