// Gives the market its lights: the moon and two glows of the sky, and as many lamps as are asked for.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/market/fixtures.h"

namespace hearth::samples::market
{

/// Number of directional lights: the moon, the town's glow and the sky's.
inline constexpr uint32_t kSunCount = 3;

/// Limits of the ranges of lamps, metres, and the factor of ranges before they are limited.
struct RangeLimits
{
    float low, high;
    float factor;
};

/// Return the limits for a number of lights: the more, the shorter, so that each point is in reach of few.
RangeLimits rangeLimits(uint32_t light_count);

/// Add `count` lights and their nodes: first the directional ones, then those of the fixtures. Large lamps
/// come before bulbs and candles.
/// fixtures  of each kind in the order in which they get lights; enough of them (asserted)
/// returns   light of each fixture, or kNoIndex
std::vector<int> addLights(Document& document, const std::vector<Fixture>& fixtures, uint32_t count);

} // namespace hearth::samples::market
