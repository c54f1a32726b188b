// Materials and lights of a pack as the shading pass reads them, and the exposure rule. Plain data, no Vulkan.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack_view.h"
#include "formats/shared/shading.h"

#include <array>
#include <vector>

namespace hearth::gpu
{

/// The textures of a material in the order of shared::kTexture*.
std::array<formats::TextureRef, shared::kTextureCount> texturesOf(const formats::MaterialRecord& material);

/// glTF's default material: white, fully metallic and rough, as its specification says.
formats::MaterialRecord defaultMaterial();

shared::Material makeMaterial(const formats::MaterialRecord& record);

/// Before exposure, and without a shadow.
shared::Light makeLight(const formats::LightRecord& record);

/// Lights and sky. A scene without lights gets one sun. The exposure rule: the light that the scene's lights send
/// together to a point in the middle of the scene is estimated; where it is more than shared::kKeyIlluminance, all lights are
/// scaled down to it, so that lamps in candela and suns in lux are shown by the same camera. Never scaled up: a dim
/// light stays dim beside the sky. Emissive factors are display-referred (1 = white) and not scaled.
shared::Lighting makeLighting(const formats::PackView& pack);

/// What the rule multiplies lights with, up to 1.
float lightExposure(const formats::PackView& pack);

} // namespace hearth::gpu
