// The lights and the sky of a scene as the runtime has them, from what is in its parts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/static_scene.h"
#include "formats/gpu_shared/shading.h"

namespace hearth::bricks
{

/// The lights of all sources, in order, as many as the runtime draws; one sun where there is none; the sky that every scene
/// has; and the exposure by its rule (runtime/gpu/README.md). What moves is not in the scene's box here: where it reaches
/// farther than all that stands still, the runtime's exposure differs, and its frames make up for that.
shared::Lighting lightingOf(const StaticScene& scene);

} // namespace hearth::bricks
