// Same as shading.frag, with shadows of the lights and indirect light from bricks (GI).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/shadow.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/scene/material.glsl"
#include "runtime/shaders/scene/surface_point.glsl"
#include "runtime/shaders/scene/resolve.glsl"
#include "runtime/shaders/scene/visibility_input.glsl"
#include "runtime/shaders/scene/material_test.glsl"
#include "runtime/shaders/shade/shadow.glsl"
#include "runtime/shaders/shade/lighting.glsl"
#include "runtime/shaders/shade/surrounding_bricks.glsl"

layout(early_fragment_tests) in; // see shading.frag
layout(location = 0) out vec4 out_color;

void main()
{
    uint id = loadVisibility();
    if (isForeign(id))
        discard;
    Surface s = resolveSurface(id, gl_FragCoord.xy);
    out_color = vec4(displayColor(surfacePoint(s), surfaceUvs(s)), 1.0);
}
