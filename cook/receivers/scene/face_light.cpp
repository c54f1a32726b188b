// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/scene/face_light.h"

#include "cook/bricks/grid/brick_view.h"
#include "cook/bricks/light/emission.h"
#include "cook/bricks/light/scene_light.h"
#include "cook/bricks/light/settled_light.h"

#include <map>

namespace hearth::receivers
{

namespace
{

/// Return the lamp of each light of the bake.
std::vector<uint32_t> findLampsOfLights(const LampTable& lamps, size_t light_count)
{
    std::vector<uint32_t> found(light_count);
    for (uint32_t lamp = 0; lamp < lamps.lights.size(); ++lamp)
        for (const size_t light : lamps.lights[lamp])
            found[light] = lamp;
    return found;
}

} // namespace

Result<std::vector<Float3>> bakeFaces(const bricks::StaticScene& scene, const formats::PackView& bricks,
                                      const shared::SceneProbes& probes, const ReceiverScene& receivers,
                                      const LampTable& lamps)
{
    const bricks::BrickView grid = bricks::makeBrickView(bricks);
    shared::SceneLighting lighting = bricks::makeSceneLighting(scene, probes);
    shared::addReflectors(lighting, bricks.reflectors());
    if (receivers.has_default_sun) // no lamp stands for it, so passes over bricks add it in each frame
        for (shared::Light& light : lighting.lights)
            light.intensity = {};
    const std::vector<uint32_t> lamps_of_lights = findLampsOfLights(lamps, receivers.bake.lightCount());
    const size_t light_count = receivers.bake.lamps.size();
    std::map<uint32_t, uint32_t> lamps_of_instances;
    for (size_t i = 0; i < receivers.mesh_light_instances.size(); ++i)
        lamps_of_instances[receivers.mesh_light_instances[i]] = lamps_of_lights[light_count + i];

    bricks::LampSources sources{
        .count = static_cast<uint32_t>(lamps.records.size()),
        .lamps_of_lights{lamps_of_lights.begin(),
                         lamps_of_lights.begin() + static_cast<ptrdiff_t>(light_count)},
        .emissions = {}};
    HEARTH_ASSIGN_OR_RETURN(const std::vector<bricks::EmissionShare> shares,
                            bricks::findEmissionShares(scene, grid));
    for (const bricks::EmissionShare& share : shares)
        if (const auto lamp = lamps_of_instances.find(share.instance); lamp != lamps_of_instances.end())
            sources.emissions.push_back({share.face, lamp->second, share.share});
    return bricks::settleLamps(grid, lighting, sources);
}

} // namespace hearth::receivers
