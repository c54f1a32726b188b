// Generates a painted sky: a hemisphere visible from inside.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/textures.h"

#include <string>

namespace hearth::samples
{

/// Return the direction of a point in the sky's image: u once around from +X over -Z, v from the horizon (1)
/// to the zenith (0).
Float3 skyDirection(Float2 uv);

/// Add a node "sky": the image on a hemisphere of `radius` metres around the origin, shown unlit.
void addSky(Document& document, const std::string& name, float radius, const ColorFunction& color_function);

} // namespace hearth::samples
