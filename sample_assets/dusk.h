// Generates the surroundings of the demo at dusk: a painted sky, hazy hills, and the brightness of everything
// against them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

/// Return the direction towards the setting sun.
Float3 duskSunDirection();

/// Add a hemisphere of sky around the origin, visible from inside, with an afterglow at the sun, and stars.
void addDuskSky(Document& document, float radius);

/// Add a material of hills that fade into the sky with distance: the haze is an emissive image along v.
int addDuskHillMaterial(Document& document);

/// Factor of all surfaces' reflectance at dusk. Renderers light a scene with a daylight sky. Surfaces reflect
/// this fraction, and the scene's own lights are scaled up by its inverse: so only the sky's light gets
/// weaker.
inline constexpr float kDuskReflectance = 0.3f;
void dimReflectance(Document& document);

} // namespace hearth::samples
