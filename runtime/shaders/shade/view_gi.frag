// Debug view of the indirect light (GI) that shading reads: irradiance / pi at the normal of the surface,
// like a white surface that only this light reaches. One full-screen triangle for all materials; the depth
// test leaves out the sky.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/scene/material.glsl"
#include "runtime/shaders/scene/surface_point.glsl"
#include "runtime/shaders/scene/resolve.glsl"
#include "runtime/shaders/scene/visibility_input.glsl"
#include "runtime/shaders/scene/material_test.glsl"
#include "runtime/shaders/shade/image_color.glsl"
#include "runtime/shaders/shade/tonemap.glsl"
#include "runtime/shaders/gi/sample_gi.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_color;

void main()
{
    uint id = loadVisibility();
    if (isForeign(id))
        discard;
    Surface s = resolveSurface(id, gl_FragCoord.xy);
    vec3 normal = smoothNormal(s) * (s.front ? 1.0 : -1.0);
    out_color = vec4(imageColor(toneMap(sampleGi(gl_FragCoord.xy, s.position, normal, 1.0).diffuse)), 1.0);
}
