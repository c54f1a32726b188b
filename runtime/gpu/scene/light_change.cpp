// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/light_change.h"

#include "formats/scene/scene_lighting.h"
#include "runtime/gpu/scene/scene_shadows.h"
#include "runtime/gpu/scene/scene_surroundings.h"

#include <cmath>
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

Result<LightChange> changeLight(const Scene& scene, uint32_t light, const formats::LightRecord& record,
                                std::optional<float> steady_intensity)
{
    const auto fail = [&](const std::string& detail) {
        return Error{Issue::usage, "", "light " + std::to_string(light), detail};
    };
    if (light >= scene.lights->layout().capacity)
        return fail("there is room for " + std::to_string(scene.lights->layout().capacity) + " (max_lights)");
    if (record.type > static_cast<uint32_t>(formats::LightType::spot))
        return fail("its type is none");
    if (!isFinite(record) || !std::isfinite(steady_intensity.value_or(0)))
        return fail("what it shall be is not finite");
    LightChange change{.light = light, .record = shared::lightFromRecord(record)};
    const float exposure = scene.lights->exposure();
    change.record.intensity = change.record.intensity * exposure;
    change.steady_luminance =
        shared::luminance(record.color * steady_intensity.value_or(record.intensity) * exposure);
    if (light >= scene.lights->loaded().size())
        return change;
    const shared::Light& loaded = scene.lights->loaded()[light];
    if (change.record.position == loaded.position)
        shared::copyReflector(change.record, loaded);
    return change;
}

void takeLights(const Scene& scene, std::span<const LightChange> lights)
{
    for (const LightChange& change : lights)
    {
        scene.lights->set(scene.tables->lighting, change.light, change.record);
        if (scene.shadows != nullptr)
            scene.shadows->change(change.light, change.steady_luminance);
        if (scene.surroundings != nullptr)
            scene.surroundings->change(change.light, change.record);
    }
    if (scene.surroundings != nullptr)
        scene.surroundings->update(scene.tables->lighting, scene.lights->layout().surroundings);
}

} // namespace hearth::gpu
