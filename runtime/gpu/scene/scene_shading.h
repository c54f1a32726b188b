// Materials and lights of a pack in the form of the shading pass, and the exposure rule. Plain data, no
// Vulkan.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shading.h"
#include "formats/pack/pack_view.h"

#include <array>
#include <vector>

namespace hearth::gpu
{

/// Textures of a material in the order of shared::kTexture*.
std::array<formats::TextureRef, shared::kTextureCount>
materialTextures(const formats::MaterialRecord& material);

/// Return glTF's default material: white, fully metallic and rough, as in its specification.
formats::MaterialRecord defaultMaterial();

shared::Material makeMaterial(const formats::MaterialRecord& record);

/// Compute lights and sky by shared::sceneLighting, with the shadow rows of the lights.
shared::Lighting makeLighting(const formats::PackView& pack);

} // namespace hearth::gpu
