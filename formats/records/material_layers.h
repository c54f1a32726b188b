// Chunk of the layers of materials: reflection beyond the metallic-roughness model.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"

#include <algorithm>
#include <span>

namespace hearth::formats
{

inline constexpr uint32_t kChunkMaterialLayers = fourCC("MLAY"); ///< MaterialLayersRecord[]

/// Layers of one material: KHR_materials_ior, _specular, _clearcoat and _sheen of glTF. Materials without
/// layers have no record.
struct MaterialLayersRecord
{
    uint32_t material;
    float ior;
    float specular;
    Float3 specular_color;
    float clearcoat;
    float clearcoat_roughness;
    float clearcoat_normal_scale;
    Float3 sheen_color;
    float sheen_roughness;
    TextureRef specular_texture;
    TextureRef clearcoat_texture;
    TextureRef clearcoat_normal_texture;
    TextureRef sheen_texture;
};

/// Textures of a record.
inline constexpr std::array kLayerTextures{
    &MaterialLayersRecord::specular_texture, &MaterialLayersRecord::clearcoat_texture,
    &MaterialLayersRecord::clearcoat_normal_texture, &MaterialLayersRecord::sheen_texture};

/// Index of refraction of materials that do not state one.
inline constexpr float kDefaultIor = 1.5f;

/// Return the layers of a material that has none: the defaults of the extensions.
inline MaterialLayersRecord neutralLayers(uint32_t material)
{
    MaterialLayersRecord layers{};
    layers.material = material;
    layers.ior = kDefaultIor;
    layers.specular = 1;
    layers.specular_color = {1, 1, 1};
    layers.clearcoat_normal_scale = 1;
    for (TextureRef MaterialLayersRecord::*const texture : kLayerTextures)
        layers.*texture = {kInvalidIndex, 0, 0, 0, 0, {1, 0, 0, 0, 1, 0}};
    return layers;
}

/// Return the record of a material, or null. Time: logarithmic.
inline const MaterialLayersRecord* findLayers(std::span<const MaterialLayersRecord> layers, uint32_t material)
{
    const auto found = std::lower_bound(layers.begin(), layers.end(), material,
                                        [](const MaterialLayersRecord& record, uint32_t wanted)
                                        { return record.material < wanted; });
    return found != layers.end() && found->material == material ? &*found : nullptr;
}

/// Return whether a material reflects as a dielectric of another reflectance than the default.
inline bool hasSpecular(const MaterialLayersRecord& layers)
{
    return layers.ior != kDefaultIor || layers.specular != 1 || layers.specular_color != Float3{1, 1, 1} ||
           layers.specular_texture.image != kInvalidIndex;
}

inline bool hasClearcoat(const MaterialLayersRecord& layers)
{
    return layers.clearcoat > 0;
}

inline bool hasSheen(const MaterialLayersRecord& layers)
{
    return layers.sheen_color != Float3{};
}

} // namespace hearth::formats

HEARTH_RECORD(
    hearth::formats::MaterialLayersRecord, 180,
    HEARTH_FIELD(hearth::formats::MaterialLayersRecord, material, "material"),
    HEARTH_FIELD(hearth::formats::MaterialLayersRecord, ior,
                 "index of refraction, at least 1; 0: reflects all light"),
    HEARTH_FIELD(hearth::formats::MaterialLayersRecord, specular, "strength of dielectric reflection, 0..1"),
    HEARTH_FIELD(hearth::formats::MaterialLayersRecord, specular_color,
                 "linear factor of its reflectance at normal incidence, may exceed 1"),
    HEARTH_FIELD(hearth::formats::MaterialLayersRecord, clearcoat, "factor 0..1; 0: no clear coat"),
    HEARTH_FIELD(hearth::formats::MaterialLayersRecord, clearcoat_roughness, "factor 0..1"),
    HEARTH_FIELD(hearth::formats::MaterialLayersRecord, clearcoat_normal_scale, ""),
    HEARTH_FIELD(hearth::formats::MaterialLayersRecord, sheen_color, "linear factor 0..1; 0: no sheen"),
    HEARTH_FIELD(hearth::formats::MaterialLayersRecord, sheen_roughness, "factor 0..1"),
    HEARTH_FIELD(hearth::formats::MaterialLayersRecord, specular_texture, "RGB specular_color, A specular"),
    HEARTH_FIELD(hearth::formats::MaterialLayersRecord, clearcoat_texture, "R clearcoat, G its roughness"),
    HEARTH_FIELD(hearth::formats::MaterialLayersRecord, clearcoat_normal_texture, "tangent space, +Y up"),
    HEARTH_FIELD(hearth::formats::MaterialLayersRecord, sheen_texture, "RGB sheen_color, A sheen_roughness"));
