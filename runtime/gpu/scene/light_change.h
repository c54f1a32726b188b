// Moving, changing and weighing lights: new rows for the tables on the device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/scene/daylight.h"
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
/// moves loses the light that its shade gives back, and what receivers have of it, until it is where it was.
/// errors: usage.
///
/// steady_intensity  without flicker, which ranks the light for shadow maps; none: the record's
Result<LightChange> changeLight(const Scene& scene, uint32_t light, const formats::LightRecord& record,
                                std::optional<float> steady_intensity = std::nullopt);

/// Sky and sun of a daylight; valid until the next one.
struct DaylightChange
{
    shared::Sky sky{};
    std::optional<LightChange> sun{}; ///< none: the scene has no sun
};

/// Compute the sky and the sun of a scene under a daylight. Its sun is the first directional light that
/// the scene was loaded with: that of scenes without lights, or one of the pack, whose colour and
/// direction it replaces. Bricks and what surroundings give back follow; the sky's light in receivers
/// follows in brightness and colour, not in direction. Light that was baked into local probes stays.
/// daylight  none: the sky and the sun as loaded
/// errors: usage: values beyond their ranges, or the sky of the scene is an image.
Result<DaylightChange> changeDaylight(const Scene& scene, const std::optional<shared::Daylight>& daylight);

/// Weight of a lamp, by which all of its light is multiplied: on surfaces, in bricks, and in the atlas of
/// receivers, bounced light included.
struct LampWeight
{
    formats::ReceiverLampKind kind = formats::ReceiverLampKind::light;
    uint32_t index = 0; ///< slot of a light, or instance that emits
    Float3 weight{1, 1, 1};
};

/// Weigh the light of a slot below SceneOptions::max_lights, of the pack or the game's. The weight stays with
/// the slot, whatever else changes its light.
/// weight  of red, green and blue: finite and at least 0
/// errors: usage.
Result<LampWeight> weighLight(const Scene& scene, uint32_t light, Float3 weight);

/// Weigh the emission of an instance, of a scene with receivers: what it shows itself, and the light that the
/// atlas has of it. Bricks have emission scales of their own (EmissionScale).
/// weight  as for a light
/// errors: usage.
Result<LampWeight> weighEmission(const Scene& scene, uint32_t instance, Float3 weight);

/// Write a daylight to the sky, to the sun, and to all that depends on them.
void takeDaylight(const Scene& scene, const DaylightChange& daylight);

/// Write changes and weights to the table of lights, to shadows, to receivers and to what the lights'
/// surroundings give back.
void takeLights(const Scene& scene, std::span<const LightChange> lights, std::span<const LampWeight> weights);

} // namespace hearth::gpu
