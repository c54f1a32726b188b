// Generates the world of the sample game: a camp between rocks, lamps along a path, and its hero.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

/// Make the scene. It has lights "sun", "fire" and "lamp_1" to "lamp_4"; the skinned "character" at its
/// origin, with clips "idle", "walk", "run" and "wave"; cameras "camp" and "shelter".
/// ground_triangles  about as many as the ground has
/// texture_size      texels along a side of the images of ground and rock
Document makeCamp(uint64_t ground_triangles, uint32_t texture_size);

} // namespace hearth::samples
