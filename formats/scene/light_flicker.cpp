// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/light_flicker.h"

#include <algorithm>

namespace hearth::formats
{

namespace
{

/// Return a number in [0, 1) with 53 random bits.
double hashToUnit(uint32_t seed, int64_t cell)
{
    // an odd factor apart from splitmix64's own keeps the rows of two seeds apart
    uint64_t bits = static_cast<uint64_t>(cell) * 0x9E3779B97F4A7C15u + seed * 0xD1B54A32D192ED03u;
    bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9u;
    bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBu;
    bits ^= bits >> 31;
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

} // namespace

double flickerNoise(uint32_t seed, double position)
{
    // doubles have no fraction from 2^52 on
    position = std::clamp(position, -0x1p52, 0x1p52);
    auto cell = static_cast<int64_t>(position);
    cell -= static_cast<double>(cell) > position ? 1 : 0;
    const double f = position - static_cast<double>(cell);
    const double weight = f * f * f * (f * (f * 6 - 15) + 10);
    const double from = hashToUnit(seed, cell), to = hashToUnit(seed, cell + 1);
    return std::clamp(from + weight * (to - from), 0.0, 1.0);
}

double flickerFactor(const LightRecord& light, double seconds)
{
    return 1 - double{light.flicker_amplitude} *
                   flickerNoise(light.flicker_seed, double{light.flicker_rate} * seconds);
}

} // namespace hearth::formats
