// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/scene_light.h"

#include "formats/scene/scene_lighting.h"

#include <vector>

namespace hearth::bricks
{

shared::SceneLighting makeSceneLighting(const StaticScene& scene, const shared::SceneProbes& probes)
{
    std::vector<formats::LightRecord> lights;
    Box3 bounds;
    for (const SourceParts& source : scene.sources)
    {
        lights.insert(lights.end(), source.scene.lights().begin(), source.scene.lights().end());
        bounds.add(shared::lightingBounds(source.scene.instances(), source.clusters.meshes()));
    }
    return shared::sceneLighting(lights, bounds, probes);
}

} // namespace hearth::bricks
