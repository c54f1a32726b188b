// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/scene_shading.h"

#include "formats/scene/reflectance.h"
#include "formats/scene/scene_lighting.h"

namespace hearth::gpu
{

namespace
{

void writeUvRows(const formats::TextureRef& texture, Float4* rows)
{
    if (texture.image == kInvalidIndex)
        return;
    const float* m = texture.uv_transform;
    rows[0] = {m[0], m[1], m[2], 0};
    rows[1] = {m[3], m[4], m[5], 0};
}

} // namespace

MaterialTextures materialTextures(const LayeredMaterial& material)
{
    const formats::MaterialRecord& base = material.base;
    const formats::MaterialLayersRecord& layers = material.layers;
    return {base.base_color_texture,  base.metallic_roughness_texture, base.normal_texture,
            base.occlusion_texture,   base.emissive_texture,           layers.specular_texture,
            layers.clearcoat_texture, layers.clearcoat_normal_texture, layers.sheen_texture};
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

std::vector<LayeredMaterial> readMaterials(const formats::PackView& pack)
{
    std::vector<LayeredMaterial> materials;
    for (uint32_t i = 0; i < pack.materials().size(); ++i)
    {
        const formats::MaterialLayersRecord* const layers = formats::findLayers(pack.materialLayers(), i);
        materials.push_back({pack.materials()[i], layers != nullptr ? *layers : formats::neutralLayers(i)});
    }
    materials.push_back({defaultMaterial(), formats::neutralLayers(kInvalidIndex)});
    return materials;
}

shared::Material makeMaterial(const LayeredMaterial& layered)
{
    const formats::MaterialRecord& record = layered.base;
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
    const MaterialTextures textures = materialTextures(layered);
    for (uint32_t slot = 0; slot < shared::kTextureCount; ++slot)
        if (textures[slot].image != kInvalidIndex)
        {
            material.textures |= 1u << slot;
            material.uv_sets |= uint32_t{textures[slot].uv_set} << (2 * slot);
        }
    for (uint32_t slot = 0; slot < shared::kFirstLayerTexture; ++slot)
        writeUvRows(textures[slot], material.uv_rows + 2 * slot);
    return material;
}

uint32_t layerBits(const formats::MaterialLayersRecord& layers)
{
    return (formats::hasSpecular(layers) ? shared::kLayerSpecular : 0) |
           (formats::hasClearcoat(layers) ? shared::kLayerClearcoat : 0) |
           (formats::hasSheen(layers) ? shared::kLayerSheen : 0);
}

shared::MaterialLayers makeLayers(const formats::MaterialLayersRecord& record)
{
    shared::MaterialLayers layers{};
    layers.dielectric_f0 = shared::dielectricF0(record);
    layers.specular = record.specular;
    layers.sheen_color = record.sheen_color;
    layers.sheen_roughness = record.sheen_roughness;
    layers.clearcoat = record.clearcoat;
    layers.clearcoat_roughness = record.clearcoat_roughness;
    layers.clearcoat_normal_scale = record.clearcoat_normal_scale;
    for (uint32_t i = 0; i < shared::kLayerTextureCount; ++i)
        writeUvRows(record.*formats::kLayerTextures[i], layers.uv_rows + 2 * i);
    return layers;
}

shared::SceneLighting makeLighting(const formats::PackView& pack)
{
    shared::SceneLighting lighting =
        shared::sceneLighting(pack.lights(), shared::lightingBounds(pack.instances(), pack.meshes()),
                              {pack.probes(), pack.probeTexels()});
    shared::addReflectors(lighting, pack.reflectors());
    return lighting;
}

} // namespace hearth::gpu
