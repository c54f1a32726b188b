// Sum of a level of bloom and the coarser ones, which a tent of 3 x 3 texels enlarges. Shares add up to 1.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#include "runtime/shaders/shade/stored_radiance.glsl"

layout(set = kSetPost, binding = kPostRadiance) uniform sampler2D level;
layout(set = kSetPost, binding = kPostBloom) uniform sampler2D coarser;
layout(push_constant) uniform Push { BloomUpPush push; };
layout(location = 0) out vec4 out_color;

void main()
{
    vec2 center = gl_FragCoord.xy / vec2(textureSize(level, 0));
    vec2 texel = 1.0 / vec2(textureSize(coarser, 0));
    vec3 tent = vec3(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            tent += float((2 - abs(x)) * (2 - abs(y))) * textureLod(coarser, center + vec2(x, y) * texel, 0.0).rgb;
    vec3 own = texelFetch(level, ivec2(gl_FragCoord.xy), 0).rgb;
    out_color = vec4(storedRadiance(mix(own, tent / 16.0, push.share)), 1.0);
}
