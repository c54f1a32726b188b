// Converts a file's lights for shading (C++ only), so that baked and drawn lighting agree.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shading.h"
#include "formats/records/scene.h"

#include <span>

namespace hearth::shared
{

/// Convert a light, before exposure, and without a shadow.
Light lightFromRecord(const formats::LightRecord& record);

/// Return the factor of the exposure rule for lights and emission, at most 1. The illuminance of all lights
/// together at a point in the middle of the scene is estimated. If it is more than kKeyIlluminance, all light
/// is scaled down to it, so that one camera shows lamps in candela and suns in lux. Light is never scaled up:
/// a dim light stays dim beside the sky. Beside lights emissive factors are nits, which the same factor makes
/// radiance; without lights the factor is 1, and an emissive factor is radiance, of which white paper in the
/// default sun has about 1. Lights beyond kMaxLights do not count.
///
/// bounds  bounds of the scene, world space, metres
float lightExposure(std::span<const formats::LightRecord> lights, const Box3& bounds);

/// Return the exposed lights, the exposure, and the sky. A scene without lights gets one sun; lights beyond
/// kMaxLights are left out.
Lighting sceneLighting(std::span<const formats::LightRecord> lights, const Box3& bounds);

} // namespace hearth::shared
