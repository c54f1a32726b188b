// Generates the moving things of the market and their clip "evening": lanterns that swing, a cart that passes
// along the street, fireflies, neon that blinks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/market/fixtures.h"

namespace hearth::samples::market
{

/// Length of the clip, seconds.
inline constexpr float kEveningSeconds = 12;

/// Return the place of the cart on the ground; it goes towards -Z at a walking pace.
Float3 cartPosition(float seconds);

/// Return the times of keys, `per_second` a second, over the whole clip.
std::vector<float> eveningTimes(float per_second);

/// Add the moving things, and their tracks to `evening`; return their fixtures.
std::vector<Fixture> addMovingLamps(Document& document, const Plan& plan, const LampModels& models,
                                    Animation& evening);

/// Add tracks to `evening` of the signs that have lights: every third one blinks, every third one changes its
/// colour.
/// light_of_fixture  as addLights() returns it
void addSignTracks(const Document& document, const std::vector<Fixture>& fixtures,
                   const std::vector<int>& light_of_fixture, Animation& evening);

} // namespace hearth::samples::market
