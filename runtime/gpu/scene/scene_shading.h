// Materials and lights of a pack as the shading pass reads them, and the exposure rule. Plain data, no Vulkan.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shading.h"
#include "formats/pack/pack_view.h"

#include <array>
#include <vector>

namespace hearth::gpu
{

/// The textures of a material in the order of shared::kTexture*.
std::array<formats::TextureRef, shared::kTextureCount> texturesOf(const formats::MaterialRecord& material);

/// glTF's default material: white, fully metallic and rough, as its specification says.
formats::MaterialRecord defaultMaterial();

shared::Material makeMaterial(const formats::MaterialRecord& record);

/// Lights and sky, by shared::sceneLighting, with the rows of their shadows.
shared::Lighting makeLighting(const formats::PackView& pack);

/// shared::lightExposure of a pack.
float lightExposure(const formats::PackView& pack);

} // namespace hearth::gpu
