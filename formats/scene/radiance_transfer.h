// Spherical harmonics of distant light, and the light of occluders under them (C++ only).
// P.-P. Sloan, J. Kautz, J. Snyder, "Precomputed radiance transfer for real-time rendering", 2002.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/occluder_light.h"
#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/sky.h"
#include "formats/records/surroundings.h"

#include <array>
#include <span>

namespace hearth::shared
{

/// Evaluate the real, orthonormal spherical harmonics of degrees 0 to 2 with +Y as their pole:
/// Y00; Y1 along y, x, z; Y2 of y y, x y, y z, x z, x x - z z.
/// direction  unit
std::array<float, formats::kLightHarmonics> evaluateHarmonics(Float3 direction);

/// Coefficients of radiance, a colour for each harmonic.
using LightHarmonics = std::array<Float3, formats::kLightHarmonics>;

/// Project distant light onto the harmonics: the sky and all directional lights. Others shine from within
/// the scene and have no coefficients.
LightHarmonics projectDistantLight(const Sky& sky, std::span<const Light> lights);

/// Return the light that occluders give back.
OccluderLight transferLight(const formats::RadianceTransferRecord& transfer, const LightHarmonics& light);

} // namespace hearth::shared
