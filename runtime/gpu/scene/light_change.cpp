// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/light_change.h"

#include "formats/scene/scene_lighting.h"
#include "runtime/gpu/scene/scene_shadows.h"
#include "runtime/gpu/scene/scene_surroundings.h"

#include <algorithm>
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

bool isWeight(Float3 weight)
{
    return std::isfinite(weight.x) && std::isfinite(weight.y) && std::isfinite(weight.z) && weight.x >= 0 &&
           weight.y >= 0 && weight.z >= 0;
}

/// Bring everything that depends on a light up to date.
void followLight(const Scene& scene, uint32_t slot)
{
    const shared::Light& light = scene.lights->lights()[slot];
    if (scene.shadows != nullptr)
        scene.shadows->change(slot, scene.lights->steadyLuminance(slot));
    if (scene.surroundings != nullptr)
        scene.surroundings->change(slot, light);
    if (scene.receivers != nullptr)
        scene.lights->setBaked(scene.tables->lighting, slot, scene.receivers->takeLight(slot, light));
}

/// Bring local probes up to date after changes of weights, of the sky's too.
void followWeights(const Scene& scene)
{
    if (scene.receivers == nullptr || scene.receivers->probeWeights().isEmpty())
        return;
    for (size_t probe = 0; probe < scene.lights->localProbes().tables.size(); ++probe)
        scene.lights->weighProbe(scene.tables->lighting, probe,
                                 scene.receivers->probeWeights().weigh(probe, scene.receivers->weights()));
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

Result<DaylightChange> changeDaylight(const Scene& scene, const std::optional<shared::Daylight>& daylight)
{
    const std::span<const shared::Light> loaded = scene.lights->loaded();
    const auto sun = std::ranges::find(loaded, shared::kLightDirectional, &shared::Light::type);
    DaylightChange change{.sky = scene.lights->loadedSky()};
    if (sun != loaded.end())
        change.sun = LightChange{.light = static_cast<uint32_t>(sun - loaded.begin()), .record = *sun};
    if (daylight)
    {
        HEARTH_TRY(shared::checkDaylight(*daylight));
        if (scene.lights->hasSkyImage())
            return Error{
                Issue::usage, "", "daylight",
                "the sky of the scene is an image: cook it without --sky, or draw it without daylight"};
        const shared::DaylightColors colors = shared::makeDaylight(*daylight);
        change.sky = {.zenith = colors.zenith, .horizon = colors.horizon, .ground = colors.ground};
        if (change.sun)
        {
            change.sun->record.direction = colors.sun_direction;
            change.sun->record.intensity = colors.sun_illuminance;
        }
    }
    if (change.sun)
        change.sun->steady_luminance = shared::luminance(change.sun->record.intensity);
    return change;
}

Result<LampWeight> weighLight(const Scene& scene, uint32_t light, Float3 weight)
{
    const auto fail = [&](const std::string& detail) {
        return Error{Issue::usage, "", "light " + std::to_string(light), detail};
    };
    if (light >= scene.lights->layout().capacity)
        return fail("there is room for " + std::to_string(scene.lights->layout().capacity) + " (max_lights)");
    if (!isWeight(weight))
        return fail("its weight is negative or not finite");
    return LampWeight{formats::ReceiverLampKind::light, light, weight};
}

Result<LampWeight> weighEmission(const Scene& scene, uint32_t instance, Float3 weight)
{
    const auto fail = [&](const std::string& detail) {
        return Error{Issue::usage, "", "instance " + std::to_string(instance), detail};
    };
    if (instance >= scene.instances.size())
        return fail("there are " + std::to_string(scene.instances.size()));
    if (scene.receivers == nullptr)
        return fail("its pack has no receivers, so emission has no weight");
    if (!isWeight(weight))
        return fail("its weight is negative or not finite");
    return LampWeight{formats::ReceiverLampKind::mesh_light, instance, weight};
}

void takeDaylight(const Scene& scene, const DaylightChange& daylight)
{
    scene.lights->setSky(daylight.sky);
    if (scene.surroundings != nullptr)
        scene.surroundings->changeSky(daylight.sky);
    if (scene.receivers != nullptr)
        scene.receivers->takeSky(daylight.sky, scene.lights->loadedSky());
    takeLights(scene, daylight.sun ? std::span(&*daylight.sun, 1) : std::span<const LightChange>{}, {});
    followWeights(scene);
}

void takeLights(const Scene& scene, std::span<const LightChange> lights, std::span<const LampWeight> weights)
{
    MirroredTable& table = scene.tables->lighting;
    for (const LightChange& change : lights)
    {
        scene.lights->set(table, change.light, change.record, change.steady_luminance);
        followLight(scene, change.light);
    }
    for (const LampWeight& weight : weights)
    {
        if (weight.kind == formats::ReceiverLampKind::light)
        {
            scene.lights->setWeight(table, weight.index, weight.weight);
            followLight(scene, weight.index);
        }
        else if (scene.receivers != nullptr)
            writeReceiverRow(scene, weight.index,
                             scene.receivers->weighEmission(weight.index, weight.weight));
    }
    if (!lights.empty() || !weights.empty())
        followWeights(scene);
    if (scene.surroundings != nullptr)
        scene.surroundings->update(table, scene.lights->layout().surroundings);
}

} // namespace hearth::gpu
