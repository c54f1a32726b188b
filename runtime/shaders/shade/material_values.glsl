// Values of a material at a surface point, from its factors and its textures. With
// HEARTH_MATERIAL_FUNCTIONS, a function of the game changes them: "Material functions" in
// runtime/c/README.md. Include behind surface_point.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_MATERIAL_VALUES_GLSL
#define HEARTH_MATERIAL_VALUES_GLSL

struct MaterialValues
{
    mediump vec3 base_color; // linear; of unlit materials the display colour
    mediump float metallic; // 0 to 1
    float roughness; // perceptual, above 0, to 1
    vec3 normal; // unit, world axes, towards the visible side
    mediump float occlusion; // share of the surrounding light that arrives
    vec3 emission; // radiance before the scene's exposure
};

#ifdef HEARTH_MATERIAL_FUNCTIONS
#include "runtime/shaders/shade/material_function.glsl"
#endif

// base_color  but for the texture: factor times vertex colour
MaterialValues materialValues(SurfacePoint point, SurfaceUvs uvs, mediump vec3 base_color)
{
    vec4 metallic_roughness = sampleSurface(uvs, kTextureMetallicRoughness, metallic_roughness_texture);
    mediump float metallic_factor = material.metallic;
    mediump float occlusion_strength = material.occlusion_strength;
    MaterialValues values;
    values.base_color = base_color * sampleSurface(uvs, kTextureBaseColor, base_color_texture).rgb;
    values.metallic = clamp(metallic_factor * metallic_roughness.b, 0.0, 1.0);
    values.roughness = surfaceRoughness(metallic_roughness);
    values.normal = shadingNormal(point, uvs);
    values.occlusion = mix(1.0, sampleSurface(uvs, kTextureOcclusion, occlusion_texture).r, occlusion_strength);
    values.emission = material.emissive * sampleSurface(uvs, kTextureEmissive, emissive_texture).rgb;
#ifdef HEARTH_MATERIAL_FUNCTIONS
    changeMaterial(values, point, uvs);
#endif
    return values;
}

#endif
