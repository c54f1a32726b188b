// Moving and changing lights: new rows for the table on the device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"

#include <optional>
#include <span>

namespace hearth::gpu
{

/// Table row for the new state of a light; valid until the next one.
struct LightChange
{
    uint32_t light = 0; ///< slot
    shared::Light record{};
    float steady_luminance = 0; ///< of its intensity without flicker
};

/// Compute the table row of a slot below SceneOptions::max_lights: one of the pack's lights, or a new one.
/// The exposure of the scene stays. A light of intensity 0 is off, which also frees a slot. A lamp that
/// moves loses the light that its shade gives back, until it is where it was. errors: usage.
///
/// steady_intensity  without flicker, which ranks the light for shadow maps; none: the record's
Result<LightChange> changeLight(const Scene& scene, uint32_t light, const formats::LightRecord& record,
                                std::optional<float> steady_intensity = std::nullopt);

/// Write changes to the table of lights, to shadows and to what the lights' surroundings give back.
void takeLights(const Scene& scene, std::span<const LightChange> lights);

} // namespace hearth::gpu
