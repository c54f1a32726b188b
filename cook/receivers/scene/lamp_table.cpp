// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/scene/lamp_table.h"

namespace hearth::receivers
{

using formats::ReceiverLampKind;

std::vector<uint32_t> findPackInstances(const bricks::StaticScene& scene)
{
    std::vector<uint32_t> first_instances;
    uint32_t next = 0;
    for (const bricks::SourceParts& source : scene.sources)
    {
        first_instances.push_back(next);
        next += static_cast<uint32_t>(source.scene.instances().size());
    }
    std::vector<uint32_t> instances;
    for (const bricks::StaticInstance& instance : scene.instances)
        instances.push_back(first_instances[instance.source] + instance.record);
    return instances;
}

LampTable makeLampTable(const ReceiverScene& receivers, std::span<const uint32_t> pack_instances)
{
    LampTable lamps;
    const auto add = [&](ReceiverLampKind kind, uint32_t index, std::vector<size_t> lights)
    {
        lamps.records.push_back({static_cast<uint32_t>(kind), index});
        lamps.lights.push_back(std::move(lights));
    };
    const size_t first_mesh_light = receivers.bake.lamps.size();
    std::vector<size_t> steady{receivers.bake.lightCount() - 1};
    if (receivers.has_default_sun)
        steady.push_back(0);
    add(ReceiverLampKind::steady, 0, std::move(steady));
    if (!receivers.has_default_sun)
        for (uint32_t i = 0; i < first_mesh_light; ++i)
            add(ReceiverLampKind::light, i, {i});
    for (size_t i = 0; i < receivers.mesh_light_instances.size(); ++i)
        add(ReceiverLampKind::mesh_light, pack_instances[receivers.mesh_light_instances[i]],
            {first_mesh_light + i});
    return lamps;
}

} // namespace hearth::receivers
