// Discards the holes of alpha-tested shadow casters.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/scene/material.glsl"
#include "runtime/shaders/draw/alpha_test.glsl"

layout(location = 0) in vec2 in_uv;
layout(location = 1) in float in_alpha;

void main()
{
    if (isHole(in_uv, in_alpha))
        discard;
}
