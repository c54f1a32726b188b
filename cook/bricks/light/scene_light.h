// Collects the lights and the sky of a scene from its parts, as the runtime does.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/static_scene.h"
#include "formats/scene/scene_lighting.h"

namespace hearth::bricks
{

/// Return the lights of all sources, in order, as many as the runtime draws; one sun if there is none; the
/// default sky; and the exposure by the runtime's rule (runtime/gpu/README.md), which counts moving instances
/// too.
shared::SceneLighting makeSceneLighting(const StaticScene& scene);

} // namespace hearth::bricks
