// Stores what lights need of the surfaces of one material, ahead of its shading. Materials that are unlit or
// have layers are not drawn by it: those with layers are lit where they are shaded.
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
#include "runtime/shaders/shade/surface_words.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out uvec4 out_surface;

void main()
{
    uint id = loadVisibility();
    if (isForeign(id))
        discard;
    Surface s = resolveSurface(id, gl_FragCoord.xy);
    SurfacePoint point = surfacePoint(s);
    SurfaceUvs uvs = surfaceUvs(s);
    vec4 metallic_roughness = sampleSurface(uvs, kTextureMetallicRoughness, metallic_roughness_texture);
    out_surface = packSurface(LitSurface(shadingNormal(point, uvs), point.flat_normal, vec3(0.0), 0.0,
                                         surfaceRoughness(metallic_roughness), point.error));
}
