// Materials and lights of a pack in the form of the shading pass, and the exposure rule. Plain data, no
// Vulkan.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "formats/scene/scene_lighting.h"

#include <array>
#include <vector>

namespace hearth::gpu
{

/// Material and its layers, which are neutral if it has none.
struct LayeredMaterial
{
    formats::MaterialRecord base;
    formats::MaterialLayersRecord layers;
};

/// Textures of a material in the order of shared::kTexture*.
using MaterialTextures = std::array<formats::TextureRef, shared::kTextureCount>;
MaterialTextures materialTextures(const LayeredMaterial& material);

/// Return glTF's default material: white, fully metallic and rough, as in its specification.
formats::MaterialRecord defaultMaterial();

/// Return the materials of a pack, and then the default material.
std::vector<LayeredMaterial> readMaterials(const formats::PackView& pack);

shared::Material makeMaterial(const LayeredMaterial& material);

/// Return the bits shared::kLayer* of the layers that a material has.
uint32_t layerBits(const formats::MaterialLayersRecord& layers);

shared::MaterialLayers makeLayers(const formats::MaterialLayersRecord& record);

/// Compute lights and sky by shared::sceneLighting, and the lights' reflectors.
shared::SceneLighting makeLighting(const formats::PackView& pack);

} // namespace hearth::gpu
