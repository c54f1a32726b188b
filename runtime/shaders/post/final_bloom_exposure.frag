// Same as final.frag, with bloom and automatic exposure.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "runtime/shaders/post/final.glsl"

layout(set = kSetPost, binding = kPostBloom) uniform sampler2D bloom;
layout(set = kSetPost, binding = kPostExposure) uniform sampler2D exposure;

void main()
{
    vec3 color = textureLod(radiance, imagePosition(), 0.0).rgb;
    color = withBloom(color, textureLod(bloom, imagePosition(), 0.0).rgb);
    out_color = finished(color, push.exposure * exp2(texelFetch(exposure, ivec2(0), 0).r));
}
