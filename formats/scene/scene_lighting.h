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

/// Return the factor of the exposure rule for all lights, at most 1. The illuminance of all lights together
/// at a point in the middle of the scene is estimated. If it is more than kKeyIlluminance, all lights are
/// scaled down to it, so that one camera shows lamps in candela and suns in lux. Lights are never scaled up:
/// a dim light stays dim beside the sky. Emissive factors are display-referred (1 = white) and not scaled.
/// Lights beyond kMaxLights do not count.
///
/// bounds  bounds of the scene, world space, metres
float lightExposure(std::span<const formats::LightRecord> lights, const Box3& bounds);

/// Return the exposed lights, and the sky. A scene without lights gets one sun; lights beyond kMaxLights are
/// left out.
Lighting sceneLighting(std::span<const formats::LightRecord> lights, const Box3& bounds);

} // namespace hearth::shared
