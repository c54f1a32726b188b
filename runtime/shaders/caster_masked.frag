// Holes cast no shadow.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/shared/shading.h"
#include "material.glsl"
#include "alpha_test.glsl"

layout(location = 0) in vec2 in_uv;
layout(location = 1) in float in_alpha;

void main()
{
    if (isHole(in_uv, in_alpha))
        discard;
}
