// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/lamp_options.h"

#include "runtime/pack/receivers/lamp_names.h"
#include "runtime/viewer/command_line.h"
#include "runtime/viewer/text.h"

#include <algorithm>
#include <optional>

namespace hearth::viewer
{

namespace
{

/// Parse one number for all channels, or three.
std::optional<Float3> parseWeight(std::string_view text)
{
    const auto parsed = parseNumbers(text);
    if (!parsed || std::ranges::any_of(*parsed, [](float number) { return number < 0; }))
        return std::nullopt;
    const std::vector<float>& numbers = *parsed;
    if (numbers.size() == 1)
        return Float3{numbers[0], numbers[0], numbers[0]};
    return numbers.size() == 3 ? std::optional(Float3{numbers[0], numbers[1], numbers[2]}) : std::nullopt;
}

} // namespace

Status parseLamp(std::string_view text, std::vector<LampSetting>& lamps)
{
    const size_t sign = text.rfind('='); // names may contain one
    const auto weight = sign == std::string_view::npos ? std::nullopt : parseWeight(text.substr(sign + 1));
    if (!weight || sign == 0)
        return usageError("--light: " + quoted(text) +
                          " is not NAME=SCALE or NAME=R,G,B with numbers of 0 or more");
    lamps.push_back({std::string(text.substr(0, sign)), *weight});
    return success();
}

Result<std::vector<gpu::LampWeight>> findLampWeights(std::span<const LampSetting> lamps,
                                                     const formats::PackView& pack, const gpu::Scene& scene)
{
    std::vector<gpu::LampWeight> weights;
    for (const LampSetting& setting : lamps)
    {
        HEARTH_ASSIGN_OR_RETURN(const std::vector<pack::NamedLamp> found,
                                pack::findLamps(pack, setting.name));
        for (const pack::NamedLamp& lamp : found)
        {
            const bool is_light = lamp.kind == formats::ReceiverLampKind::light;
            if (is_light && lamp.index >= scene.lights->lights().size())
                continue;
            HEARTH_ASSIGN_OR_RETURN(const gpu::LampWeight weight,
                                    is_light ? gpu::weighLight(scene, lamp.index, setting.weight)
                                             : gpu::weighEmission(scene, lamp.index, setting.weight));
            weights.push_back(weight);
        }
    }
    return weights;
}

} // namespace hearth::viewer
