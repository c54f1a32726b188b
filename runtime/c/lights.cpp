// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/lights.h"

#include <algorithm>
#include <cmath>

namespace hearth::c
{

Status makeLights(hearth_scene& scene, const hearth_frame& frame)
{
    if (frame.light_count > 0 && frame.lights == nullptr)
        return usage("lights is NULL");
    scene.lights.clear();
    for (uint32_t i = 0; i < frame.light_count; ++i)
    {
        const hearth_light_change& change = frame.lights[i];
        const std::span<const shared::Light> lights = scene.scene->lights->lights();
        const uint32_t capacity = scene.scene->lights->layout().capacity;
        if (change.light >= capacity && change.light - capacity < scene.scene->dropped_lights)
            continue;
        formats::LightRecord record{};
        if (change.type > HEARTH_LIGHT_SPOT)
            return usage("light " + std::to_string(change.light) +
                         " has a type that this version does not know");
        if (change.type != HEARTH_LIGHT_SAME)
            record.type = change.type - HEARTH_LIGHT_SUN;
        else if (change.light < lights.size())
            record.type = lights[change.light].type;
        static_assert(sizeof(record.world_from_light.m) == sizeof(change.world_from_light));
        std::copy_n(&change.world_from_light[0][0], 12, &record.world_from_light.m[0][0]);
        record.color = {change.color[0], change.color[1], change.color[2]};
        record.intensity = change.intensity;
        record.range = change.range;
        record.inner_cone_rad = change.inner_cone_rad;
        record.outer_cone_rad = change.outer_cone_rad;
        const auto steady_intensity =
            change.steady_intensity == 0 ? std::nullopt : std::optional(change.steady_intensity);
        HEARTH_ASSIGN_OR_RETURN(const gpu::LightChange made,
                                gpu::changeLight(*scene.scene, change.light, record, steady_intensity));
        scene.lights.push_back(made);
    }
    return success();
}

Status makeDaylight(hearth_scene& scene, const hearth_frame& frame)
{
    scene.daylight.reset();
    if (frame.daylight == nullptr)
        return success();
    const hearth_daylight& wanted = *frame.daylight;
    if (wanted.reserved != 0)
        return usage("reserved of daylight is not 0");
    std::optional<shared::Daylight> daylight;
    if (wanted.turbidity != 0)
        daylight = {wanted.elevation_deg, wanted.azimuth_deg, wanted.turbidity};
    HEARTH_ASSIGN_OR_RETURN(scene.daylight, gpu::changeDaylight(*scene.scene, daylight));
    return success();
}

Status makeLampWeights(hearth_scene& scene, const hearth_frame& frame)
{
    if (frame.lamp_weight_count > 0 && frame.lamp_weights == nullptr)
        return usage("lamp_weights is NULL");
    scene.lamp_weights.clear();
    for (uint32_t i = 0; i < frame.lamp_weight_count; ++i)
    {
        const hearth_lamp_weight& lamp = frame.lamp_weights[i];
        if (lamp.lamp != HEARTH_LAMP_LIGHT && lamp.lamp != HEARTH_LAMP_EMISSION)
            return usage("lamp weight " + std::to_string(i) +
                         " is of a lamp that this version does not know");
        const Float3 weight{lamp.weight[0], lamp.weight[1], lamp.weight[2]};
        HEARTH_ASSIGN_OR_RETURN(const gpu::LampWeight made,
                                lamp.lamp == HEARTH_LAMP_LIGHT
                                    ? gpu::weighLight(*scene.scene, lamp.index, weight)
                                    : gpu::weighEmission(*scene.scene, lamp.index, weight));
        scene.lamp_weights.push_back(made);
    }
    return success();
}

Status makeEmissions(hearth_scene& scene, const hearth_frame& frame)
{
    if (frame.emission_count > 0 && frame.emissions == nullptr)
        return usage("emissions is NULL");
    if (frame.emission_count > shared::kMaxEmissionBoxes)
        return usage("emission_count is above " + std::to_string(shared::kMaxEmissionBoxes));
    if (frame.emission_count > 0 && scene.scene->receivers != nullptr && scene.scene->receivers->faces)
        return usage("emissions: the bricks of the pack have receivers; weigh the emission of instances "
                     "(HEARTH_LAMP_EMISSION) instead");
    scene.emissions.clear();
    for (uint32_t i = 0; i < frame.emission_count; ++i)
    {
        const hearth_emission_scale& e = frame.emissions[i];
        const float values[] = {e.box_min[0], e.box_min[1], e.box_min[2], e.box_max[0],
                                e.box_max[1], e.box_max[2], e.factor};
        if (!std::all_of(std::begin(values), std::end(values), [](float v) { return std::isfinite(v); }) ||
            e.factor < 0)
            return usage("emission " + std::to_string(i) + " is not finite with a factor from 0");
        scene.emissions.push_back(
            {.box = {{e.box_min[0], e.box_min[1], e.box_min[2]}, {e.box_max[0], e.box_max[1], e.box_max[2]}},
             .factor = e.factor});
    }
    return success();
}

} // namespace hearth::c
