// Lights that move or change: new rows for the table on the device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"

#include <span>

namespace hearth::gpu
{

/// What a light is from now on; holds until the next one.
struct LightChange
{
    uint32_t light = 0;
    shared::Light record{};
};

/// Of a light that is drawn: another place, direction, colour, intensity, range or cone, of the same type. The scene's
/// exposure stays. A light of intensity 0 is off. errors: usage.
Result<LightChange> changeLight(const Scene& scene, uint32_t light, const formats::LightRecord& record);

/// One small copy for each. Between barriers of the caller: after all that reads the table, before what shall see the new
/// ones.
void recordLights(const Device& device, VkCommandBuffer commands, const Scene& scene,
                  std::span<const LightChange> lights);

} // namespace hearth::gpu
