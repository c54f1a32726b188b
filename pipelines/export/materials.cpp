// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/materials.h"

#include "pipelines/export/textures.h"

#include <algorithm>
#include <cmath>

namespace hearth::gltf_export
{

using namespace formats;

namespace
{

std::array<double, 3> toArray(Float3 v)
{
    return {double{v.x}, double{v.y}, double{v.z}};
}

std::string alphaModeName(uint32_t mode)
{
    switch (static_cast<AlphaMode>(mode))
    {
    case AlphaMode::mask:
        return "MASK";
    case AlphaMode::blend:
        return "BLEND";
    default:
        return "OPAQUE";
    }
}

/// Set factors of at most 1 and a strength. A power of 2 as strength divides and multiplies without a
/// rounding.
void setEmissive(Float3 emissive, Material& material)
{
    const float largest = std::max({emissive.x, emissive.y, emissive.z});
    int exponent = 0;
    if (largest > 1 && std::frexp(largest, &exponent) == 0.5f)
        --exponent;
    material.emissive_strength = std::ldexp(1.0, exponent > 0 && largest > 1 ? exponent : 0);
    material.emissive = toArray(emissive);
    for (double& factor : material.emissive)
        factor /= material.emissive_strength;
}

Status setLayers(const MaterialLayersRecord& layers, TextureSet& textures, Material& material)
{
    if (layers.ior != kDefaultIor)
        material.ior = double{layers.ior};
    // an image of the pack has the channels of both textures that read it
    HEARTH_ASSIGN_OR_RETURN(const TextureUse specular, textures.use(layers.specular_texture));
    if (layers.specular != 1 || layers.specular_color != Float3{1, 1, 1} || specular.texture != kInvalidIndex)
        material.specular =
            Specular{double{layers.specular}, toArray(layers.specular_color), specular, specular};
    if (hasClearcoat(layers))
    {
        Clearcoat clearcoat{double{layers.clearcoat},
                            double{layers.clearcoat_roughness},
                            double{layers.clearcoat_normal_scale},
                            {},
                            {},
                            {}};
        HEARTH_ASSIGN_OR_RETURN(clearcoat.texture, textures.use(layers.clearcoat_texture));
        if (layers.clearcoat_roughness > 0)
            clearcoat.roughness_texture = clearcoat.texture;
        HEARTH_ASSIGN_OR_RETURN(clearcoat.normal_texture, textures.use(layers.clearcoat_normal_texture));
        material.clearcoat = clearcoat;
    }
    if (hasSheen(layers))
    {
        Sheen sheen{toArray(layers.sheen_color), double{layers.sheen_roughness}, {}, {}};
        HEARTH_ASSIGN_OR_RETURN(sheen.color_texture, textures.use(layers.sheen_texture));
        if (layers.sheen_roughness > 0)
            sheen.roughness_texture = sheen.color_texture;
        material.sheen = sheen;
    }
    return success();
}

Result<Material> convert(const PackView& pack, uint32_t index, TextureSet& textures)
{
    const MaterialRecord& record = pack.materials()[index];
    Material material;
    material.name = pack.text(record.name);
    material.base_color = {double{record.base_color.x}, double{record.base_color.y},
                           double{record.base_color.z}, double{record.base_color.w}};
    material.metallic = double{record.metallic};
    material.roughness = double{record.roughness};
    material.normal_scale = double{record.normal_scale};
    material.occlusion_strength = double{record.occlusion_strength};
    setEmissive(record.emissive, material);
    material.alpha_mode = alphaModeName(record.alpha_mode);
    if (record.alpha_mode == static_cast<uint32_t>(AlphaMode::mask))
        material.alpha_cutoff = double{record.alpha_cutoff};
    material.is_double_sided = (record.flags & kMaterialDoubleSided) != 0;
    material.is_unlit = (record.flags & kMaterialUnlit) != 0;
    HEARTH_ASSIGN_OR_RETURN(material.base_color_texture, textures.use(record.base_color_texture));
    HEARTH_ASSIGN_OR_RETURN(material.metallic_roughness_texture,
                            textures.use(record.metallic_roughness_texture));
    HEARTH_ASSIGN_OR_RETURN(material.normal_texture, textures.use(record.normal_texture));
    HEARTH_ASSIGN_OR_RETURN(material.occlusion_texture, textures.use(record.occlusion_texture));
    HEARTH_ASSIGN_OR_RETURN(material.emissive_texture, textures.use(record.emissive_texture));
    if (const MaterialLayersRecord* const layers = findLayers(pack.materialLayers(), index))
        HEARTH_TRY(setLayers(*layers, textures, material));
    return material;
}

} // namespace

Status addMaterials(GltfDocument& document, const PackView& pack, Omissions& omissions)
{
    TextureSet textures(document, pack, omissions);
    for (uint32_t i = 0; i < pack.materials().size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(Material material, convert(pack, i, textures));
        document.materials.push_back(std::move(material));
    }
    return success();
}

} // namespace hearth::gltf_export
