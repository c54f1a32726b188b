// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/lamp_weights.h"

#include <algorithm>

namespace hearth::viewer
{

Result<std::vector<LampControl>> listLampControls(const formats::PackView& pack,
                                                  std::span<const LampSetting> options)
{
    std::vector<LampControl> controls;
    for (const pack::NamedLamp& lamp : pack::listLamps(pack))
        controls.push_back({.lamp = lamp});
    for (const LampSetting& option : options)
    {
        HEARTH_TRY(pack::findLamps(pack, option.name));
        const Float3 weight = option.weight;
        const float brightest = std::max(weight.x, std::max(weight.y, weight.z));
        for (LampControl& control : controls)
            if (control.lamp.name == option.name)
            {
                control.brightness = brightest;
                control.color = brightest > 0 ? weight / brightest : Float3{1, 1, 1};
            }
    }
    return controls;
}

Status SceneLampWeights::update(std::span<const LampControl> lamps, const gpu::Scene& scene)
{
    changes_.clear();
    weights_.resize(lamps.size(), Float3{1, 1, 1});
    for (size_t i = 0; i < lamps.size(); ++i)
    {
        const pack::NamedLamp& lamp = lamps[i].lamp;
        const bool is_light = lamp.kind == formats::ReceiverLampKind::light;
        const Float3 weight = lamps[i].weight();
        if (weight == weights_[i] || (is_light && lamp.index >= scene.lights->lights().size()))
            continue;
        HEARTH_ASSIGN_OR_RETURN(const gpu::LampWeight change,
                                is_light ? gpu::weighLight(scene, lamp.index, weight)
                                         : gpu::weighEmission(scene, lamp.index, weight));
        changes_.push_back(change);
        weights_[i] = weight;
    }
    return success();
}

} // namespace hearth::viewer
