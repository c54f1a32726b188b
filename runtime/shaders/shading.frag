// Shades the pixels of one material: rebuilds the surface, and shades it with exact derivatives of its UVs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/shared/decisions.h"
#include "formats/shared/shading.h"
#include "scene.glsl"
#include "material.glsl"
#include "surface_point.glsl"
#include "resolve.glsl"
#include "unshadowed.glsl"
#include "lighting.glsl"
#include "surrounding_sky.glsl"

layout(input_attachment_index = 0, set = 2, binding = 0) uniform usubpassInput visibility;

// said aloud because lavapipe else shades every pixel before it tests: five times the time of a frame
layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_color;

void main()
{
    Surface s = resolveSurface(subpassLoad(visibility).x, gl_FragCoord.xy);
    out_color = vec4(displayColor(surfacePoint(s), surfaceUvs(s)), 1.0);
}
