// Finishes a frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "runtime/shaders/post/final.glsl"

void main()
{
    vec3 color = textureLod(radiance, imagePosition(), 0.0).rgb;
    out_color = finished(color, push.exposure);
}
