// Same as overdraw.frag, with alpha test.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/scene/material.glsl"
#include "runtime/shaders/draw/alpha_test.glsl"

layout(location = 0) flat in uint in_id;
layout(location = 1) in vec2 in_uv;
layout(location = 2) in float in_alpha;
layout(location = 0) out vec4 out_color;

void main()
{
    if (isHole(in_uv, in_alpha))
        discard;
    out_color = vec4(kOverdrawStep, float(in_id));
}
