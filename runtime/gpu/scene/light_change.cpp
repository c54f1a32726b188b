// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/light_change.h"

#include "formats/scene/scene_lighting.h"
#include "runtime/gpu/scene/scene_shadows.h"
#include "runtime/gpu/scene/scene_surroundings.h"

#include <cmath>
#include <cstddef>
#include <string>

namespace hearth::gpu
{

namespace
{

bool isFinite(const formats::LightRecord& record)
{
    for (const auto& row : record.world_from_light.m)
        for (const float value : row)
            if (!std::isfinite(value))
                return false;
    return std::isfinite(record.color.x) && std::isfinite(record.color.y) && std::isfinite(record.color.z) &&
           std::isfinite(record.intensity) && std::isfinite(record.range) &&
           std::isfinite(record.inner_cone_rad) && std::isfinite(record.outer_cone_rad);
}

} // namespace

Result<LightChange> changeLight(const Scene& scene, uint32_t light, const formats::LightRecord& record)
{
    const auto fail = [&](const std::string& detail) {
        return Error{Issue::usage, "", "light " + std::to_string(light), detail};
    };
    if (light >= scene.lights.size())
        return fail("there are " + std::to_string(scene.lights.size()) + " that are drawn");
    if (record.type != scene.lights[light].type)
        return fail("a light stays a sun, a lamp or a spot");
    if (!isFinite(record))
        return fail("what it shall be is not finite");
    LightChange change{.light = light, .record = shared::lightFromRecord(record)};
    change.record.intensity = change.record.intensity * scene.exposure;
    change.record.shadow_row = scene.lights[light].shadow_row;
    if (change.record.position == scene.lights[light].position)
        shared::copyReflector(change.record, scene.lights[light]);
    return change;
}

void takeLights(const Scene& scene, std::span<const LightChange> lights)
{
    for (const LightChange& change : lights)
    {
        scene.tables->lighting.write(offsetof(shared::Lighting, lights) +
                                         change.light * sizeof(shared::Light),
                                     std::as_bytes(std::span(&change.record, 1)));
        if (scene.shadows != nullptr)
            scene.shadows->change(change.light, change.record);
        if (scene.surroundings != nullptr)
            scene.surroundings->change(change.light, change.record);
    }
    if (scene.surroundings != nullptr)
        scene.surroundings->update(scene.tables->lighting);
}

} // namespace hearth::gpu
