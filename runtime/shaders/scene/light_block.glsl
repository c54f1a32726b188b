// Lights and sky of the frame, and the surroundings of instances. Needs formats/gpu_shared/shading.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/occluder_light.h"

layout(set = kSetScene, binding = kSceneLighting, std140) readonly buffer LightingBlock
{
    Lighting lighting;
    uvec4 surroundings[]; // rows as in formats/gpu_shared/occluder_light.h
};

const OccluderLight kNoOccluderLight = OccluderLight(vec4(0.0), vec4(0.0), vec4(0.0));

// Light that the occluders of an instance give back.
OccluderLight occluderLight(uint instance)
{
    if (lighting.surroundings_row == kNoSurroundings)
        return kNoOccluderLight;
    uint transfer = surroundings[lighting.surroundings_row + instance].x;
    if (transfer == kNoTransfer)
        return kNoOccluderLight;
    uint row = transfer * kOccluderLightRows;
    return OccluderLight(uintBitsToFloat(surroundings[row]), uintBitsToFloat(surroundings[row + 1u]),
                         uintBitsToFloat(surroundings[row + 2u]));
}

// Factor of the visibility of an instance's mesh: terms of the direction, and 1.
vec4 instanceVisibility(uint instance)
{
    if (lighting.surroundings_row == kNoSurroundings)
        return vec4(0.0, 0.0, 0.0, 1.0);
    uvec4 row = surroundings[lighting.surroundings_row + instance];
    return vec4(unpackHalf2x16(row.y), unpackHalf2x16(row.z));
}
