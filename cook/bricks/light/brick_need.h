// Decides whether a scene needs bricks, for cooks that leave it to the scene.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/grid_settings.h"
#include "cook/bricks/voxels/static_scene.h"

#include <string>

namespace hearth::bricks
{

/// Return why the scene needs no bricks; empty if it needs them, because it sees little of the sky
/// (light/sky_sight.h). Several assets that were never placed are no scene, and need none.
/// errors: of makeGridFrame and of decoding pages
Result<std::string> findReasonForNoBricks(const StaticScene& scene, const GridSettings& settings);

} // namespace hearth::bricks
