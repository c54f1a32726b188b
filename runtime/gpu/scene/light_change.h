// Moving and changing lights: new rows for the table on the device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"

#include <span>

namespace hearth::gpu
{

/// Table row for the new state of a light; valid until the next one.
struct LightChange
{
    uint32_t light = 0;
    shared::Light record{};
};

/// Compute the table row of a light that is drawn: new position, direction, colour, intensity, range or cone,
/// same type. The exposure of the scene stays. A light of intensity 0 is off. A lamp that moves loses the
/// light that its shade gives back, until it is where it was. errors: usage.
Result<LightChange> changeLight(const Scene& scene, uint32_t light, const formats::LightRecord& record);

/// Write changes to the table of lights, to shadows and to what the lights' surroundings give back.
void takeLights(const Scene& scene, std::span<const LightChange> lights);

} // namespace hearth::gpu
