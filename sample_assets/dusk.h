// The surroundings of the demo at dusk: a painted sky, hazy hills, and how bright everything is against them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

/// Direction towards the sun, which has almost set.
Float3 duskSunDirection();

/// A hemisphere of sky around the origin, seen from within, with an afterglow where the sun is, and stars.
void addDuskSky(Document& document, float radius);

/// Hills that fade into the sky with distance: the haze is an emissive picture along v.
int addDuskHillMaterial(Document& document);

/// Renderers light a scene with the sky of a day. At dusk surfaces send back this part of what they do by day, and
/// the scene's own lights are made stronger by as much: only the sky's light gets weaker.
inline constexpr float kDuskReflectance = 0.3f;
void dimReflectance(Document& document);

} // namespace hearth::samples
