// A painted sky: a hemisphere that is seen from within.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/textures.h"

#include <string>

namespace hearth::samples
{

/// Direction of a place in the sky's picture: u once around from +X over -Z, v from the horizon (1) to the zenith (0).
Float3 skyDirection(Float2 uv);

/// Adds a node "sky": the picture on a hemisphere of `radius` metres around the origin, shown as it is.
void addSky(Document& document, const std::string& name, float radius, const Picture& picture);

} // namespace hearth::samples
