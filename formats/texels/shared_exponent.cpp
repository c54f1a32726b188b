// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/shared_exponent.h"

#include <algorithm>
#include <cmath>

namespace hearth::formats
{

namespace
{

constexpr int kExponentBias = 15, kMantissaBits = 9;

} // namespace

uint32_t encodeSharedExponent(const std::array<double, 3>& color)
{
    std::array<double, 3> channels;
    for (size_t c = 0; c < 3; ++c)
        channels[c] = std::clamp(color[c], 0.0, kMaxSharedExponentValue);
    const double largest = *std::max_element(channels.begin(), channels.end());
    if (largest == 0)
        return 0;
    int exponent = std::max(-kExponentBias - 1, std::ilogb(largest)) + 1 + kExponentBias;
    double step = std::ldexp(1.0, exponent - kExponentBias - kMantissaBits);
    if (std::floor(largest / step + 0.5) == 1 << kMantissaBits) // rounded up past the mantissa
    {
        step *= 2;
        ++exponent;
    }
    uint32_t word = static_cast<uint32_t>(exponent) << 27;
    for (size_t c = 0; c < 3; ++c)
        word |= static_cast<uint32_t>(std::floor(channels[c] / step + 0.5)) << (9 * c);
    return word;
}

std::array<float, 3> decodeSharedExponent(uint32_t word)
{
    const auto exponent = static_cast<int>(word >> 27);
    const auto channel = [&](uint32_t shift) {
        return std::ldexp(static_cast<float>(word >> shift & 0x1FF),
                          exponent - kExponentBias - kMantissaBits);
    };
    return {channel(0), channel(9), channel(18)};
}

} // namespace hearth::formats
