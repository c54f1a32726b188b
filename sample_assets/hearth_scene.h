// Generates the scene of ./dev demo: a campfire at dusk in front of a large boulder.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

/// Make the scene. `hero_triangles`: triangles of the boulder. One camera "hearth", a low sun, the fire's
/// point light.
Document makeHearthScene(uint64_t hero_triangles, uint32_t texture_size);

} // namespace hearth::samples
