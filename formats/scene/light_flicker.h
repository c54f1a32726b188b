// Flicker of punctual lights, as of flames: smooth noise over time. It is a function of light and time alone,
// computed by + - * of doubles and by integers, so that all machines agree on its bits.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"

namespace hearth::formats
{

/// Return value noise in [0, 1] of mean 1/2: a hash at each integer, and between two of them a curve with
/// continuous first and second derivatives.
/// position  finite; beyond 2^52 the noise is constant
/// source    K. Perlin, "Improving noise", 2002 (the curve); S. Vigna, splitmix64, 2015 (the hash)
double flickerNoise(uint32_t seed, double position);

/// Return the factor on a light's intensity at a time: 1 - amplitude * flickerNoise(seed, rate * seconds). A
/// steady light has 1. Exact to 2e-9 of a period after 100 days at 1 Hz.
/// seconds  finite
double flickerFactor(const LightRecord& light, double seconds);

} // namespace hearth::formats
