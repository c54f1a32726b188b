// Baked light of a pixel, from the atlas of receivers: irradiance under the weights of its lamps. Include
// behind light_block.glsl and resolve.glsl. Scenes without receivers have none of this code.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/receivers/receiver_rows.h"
#include "formats/gpu_shared/specialization.h"

layout(constant_id = kConstantReceivers) const bool kReceivers = false;

// words of E5B9G9R9 in this format: filtered
layout(set = kSetScene, binding = kSceneReceivers) uniform sampler2D receiver_atlas;

ReceiverRow receiverRow(uint instance)
{
    uvec4 row = light_rows[lighting.receivers_row + instance];
    return ReceiverRow(row.x, row.y, row.z, row.w);
}

// True if the pixel's diffuse light is in the atlas. Texels hold the light of front sides.
bool isReceiver(ReceiverRow row, Surface s) { return row.size != 0u && s.front; }

vec2 surfaceReceiverTexel(ReceiverRow row, Surface s)
{
    uint set = row.place >> kReceiverUvSetShift;
    vec2 uv = vertexUv(s.draw, s.vertices[0], set) * s.weights.x + vertexUv(s.draw, s.vertices[1], set) * s.weights.y +
              vertexUv(s.draw, s.vertices[2], set) * s.weights.z;
    return receiverTexel(row.place, row.size, uv);
}

// Irradiance at a place in the atlas, texels.
vec3 sampleReceivers(vec2 texel)
{
    vec2 at = texel / vec2(lighting.receiver_width, lighting.receiver_height);
    return textureLod(receiver_atlas, at, 0.0).rgb * lighting.receiver_scale; // one mip
}

vec3 emissionWeight(ReceiverRow row)
{
    return vec3(unpackHalf2x16(row.emission_red_green), unpackHalf2x16(row.emission_blue).x);
}

// Light that the atlas has for the pixel, for shading. Surfaces of scenes without receivers have none.
ReceivedLight surfaceReceivedLight(Surface s)
{
    ReceivedLight light = kNoReceivedLight;
    if (!kReceivers)
        return light;
    ReceiverRow row = receiverRow(s.slot.instance);
    light.emission_weight = emissionWeight(row);
    light.is_known = isReceiver(row, s);
    if (light.is_known)
        light.mean_radiance = sampleReceivers(surfaceReceiverTexel(row, s)) / kVisibilityPi;
    return light;
}
