// Material of a draw: set 1 of the pipelines that read materials.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_MATERIAL_GLSL
#define HEARTH_MATERIAL_GLSL

#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/record_values.h"
#include "formats/gpu_shared/shading.h"

layout(set = kSetMaterial, binding = kMaterialBlock, std140) uniform MaterialBlock { Material material; };
layout(set = kSetMaterial, binding = kMaterialTextures + kTextureBaseColor) uniform sampler2D base_color_texture;
layout(set = kSetMaterial, binding = kMaterialTextures + kTextureMetallicRoughness) uniform sampler2D metallic_roughness_texture;
layout(set = kSetMaterial, binding = kMaterialTextures + kTextureNormal) uniform sampler2D normal_texture;
layout(set = kSetMaterial, binding = kMaterialTextures + kTextureOcclusion) uniform sampler2D occlusion_texture;
layout(set = kSetMaterial, binding = kMaterialTextures + kTextureEmissive) uniform sampler2D emissive_texture;

vec2 transformUv(uint slot, vec2 uv)
{
    vec3 point = vec3(uv, 1.0);
    return vec2(dot(material.uv_rows[2u * slot].xyz, point), dot(material.uv_rows[2u * slot + 1u].xyz, point));
}

// Transform a direction in UV space (a derivative) in the same way.
vec2 transformUvVector(uint slot, vec2 d)
{
    return vec2(dot(material.uv_rows[2u * slot].xy, d), dot(material.uv_rows[2u * slot + 1u].xy, d));
}

#endif
