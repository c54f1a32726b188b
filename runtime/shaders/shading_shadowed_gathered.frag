// As shading.frag, with the shadows of the lights and the light of bricks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/shared/shading.h"
#include "formats/shared/shadow.h"
#include "scene.glsl"
#include "material.glsl"
#include "surface_point.glsl"
#include "resolve.glsl"
#include "shadow.glsl"
#include "lighting.glsl"
#include "surrounding_bricks.glsl"

layout(input_attachment_index = 0, set = 2, binding = 0) uniform usubpassInput visibility;

layout(early_fragment_tests) in; // as shading.frag
layout(location = 0) out vec4 out_color;

void main()
{
    Surface s = resolveSurface(subpassLoad(visibility).x, gl_FragCoord.xy);
    out_color = vec4(displayColor(surfacePoint(s), surfaceUvs(s)), 1.0);
}
