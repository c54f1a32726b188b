// Collects the lights and the sky of a scene from its parts, as the runtime does.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/static_scene.h"
#include "formats/scene/scene_lighting.h"

namespace hearth::bricks
{

/// Return the lights of all sources, in order, as many as the runtime draws; the sky of a probe, or else the
/// default sky, with a sun if there are no lights; and the exposure by the runtime's rule
/// (runtime/gpu/README.md), which counts moving instances too.
shared::SceneLighting makeSceneLighting(const StaticScene& scene, const shared::SceneProbes& probes = {});

} // namespace hearth::bricks
