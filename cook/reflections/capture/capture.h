// Captures what a point of a scene sees, in all directions.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/environment/environment.h"
#include "cook/reflections/capture/path_light.h"

#include <optional>

namespace hearth::reflections
{

struct Capture
{
    environment::Environment radiance;                            ///< a cube
    Float4 sky_share;                                             ///< as formats::ProbeRecord
    std::array<float, formats::kLightHarmonics> lamp_harmonics{}; ///< PathLight::lampHarmonics
    double black_share = 0; ///< of all directions: those in which backs of surfaces are met
};

/// Capture the radiance around a position. The same for any number of threads.
/// sky   image of the sky that rays see which meet nothing; none: that of the lighting
/// side  texels of an edge of the cube
Capture captureRadiance(const Surfaces& surfaces, const shared::SceneLighting& lighting,
                        const std::optional<environment::Environment>& sky, Float3 position, uint32_t side);

/// Find the box around a position: from the first surface along each axis to that on the other side.
/// If an axis meets nothing, the box ends as far beyond the scene as the scene is large, so that the
/// light from there has next to no parallax.
Box3 findBox(const Surfaces& surfaces, Float3 position);

} // namespace hearth::reflections
