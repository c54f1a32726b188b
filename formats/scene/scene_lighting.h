// C++ only: a file's lights as shading takes them, so that what is baked and what is drawn is lit alike.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shading.h"
#include "formats/records/scene.h"

#include <span>

namespace hearth::shared
{

/// Before exposure, and without a shadow.
Light lightOf(const formats::LightRecord& record);

/// What the exposure rule multiplies lights with, up to 1: the light that the scene's lights send together to a point in the
/// middle of the scene is estimated; where it is more than kKeyIlluminance, all lights are scaled down to it, so that lamps in
/// candela and suns in lux are shown by the same camera. Never scaled up: a dim light stays dim beside the sky. Emissive
/// factors are display-referred (1 = white) and not scaled. Lights beyond kMaxLights do not count.
///
/// bounds  of the scene, world space, metres
float lightExposure(std::span<const formats::LightRecord> lights, const Box3& bounds);

/// Lights, exposed, and sky. A scene without lights gets one sun; lights beyond kMaxLights are left out.
Lighting sceneLighting(std::span<const formats::LightRecord> lights, const Box3& bounds);

} // namespace hearth::shared
