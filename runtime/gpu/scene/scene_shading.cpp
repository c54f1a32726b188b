// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/scene_shading.h"

#include "formats/scene/scene_lighting.h"
#include "runtime/gpu/scene/scene_boxes.h"
#include "runtime/gpu/scene/shadow_plan.h"

namespace hearth::gpu
{

std::array<formats::TextureRef, shared::kTextureCount>
materialTextures(const formats::MaterialRecord& material)
{
    return {material.base_color_texture, material.metallic_roughness_texture, material.normal_texture,
            material.occlusion_texture, material.emissive_texture};
}

formats::MaterialRecord defaultMaterial()
{
    formats::MaterialRecord material{};
    material.base_color = {1, 1, 1, 1};
    material.alpha_cutoff = 0.5f;
    material.metallic = 1;
    material.roughness = 1;
    material.normal_scale = 1;
    material.occlusion_strength = 1;
    for (formats::TextureRef* texture :
         {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
          &material.occlusion_texture, &material.emissive_texture})
        texture->image = kInvalidIndex;
    return material;
}

shared::Material makeMaterial(const formats::MaterialRecord& record)
{
    shared::Material material{};
    material.base_color = record.base_color;
    material.emissive = record.emissive;
    material.alpha_cutoff = record.alpha_cutoff;
    material.metallic = record.metallic;
    material.roughness = record.roughness;
    material.normal_scale = record.normal_scale;
    material.occlusion_strength = record.occlusion_strength;
    material.flags = record.flags;
    material.alpha_mode = record.alpha_mode;
    const auto textures = materialTextures(record);
    for (uint32_t slot = 0; slot < shared::kTextureCount; ++slot)
    {
        const formats::TextureRef& texture = textures[slot];
        if (texture.image == kInvalidIndex)
            continue;
        material.textures |= 1u << slot;
        material.uv_sets |= uint32_t{texture.uv_set} << (4 * slot);
        const float* m = texture.uv_transform;
        material.uv_rows[2 * slot] = {m[0], m[1], m[2], 0};
        material.uv_rows[2 * slot + 1] = {m[3], m[4], m[5], 0};
    }
    return material;
}

shared::Lighting makeLighting(const formats::PackView& pack)
{
    shared::Lighting lighting = shared::sceneLighting(pack.lights(), sceneBounds(pack));
    assignShadowRows(lighting);
    return lighting;
}

} // namespace hearth::gpu
