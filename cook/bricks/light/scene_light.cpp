// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/scene_light.h"

#include "formats/scene/scene_lighting.h"

#include <vector>

namespace hearth::bricks
{

shared::Lighting makeSceneLighting(const StaticScene& scene)
{
    std::vector<formats::LightRecord> lights;
    for (const SourceParts& source : scene.sources)
        lights.insert(lights.end(), source.scene.lights().begin(), source.scene.lights().end());
    return shared::sceneLighting(lights, scene.box());
}

} // namespace hearth::bricks
