// Result of decoding, common to all formats.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstdint>

namespace hearth::formats
{

/// Red, green, blue, alpha. Absent colours are 0, absent alpha is 1.
///   unorm  0 to 65535
///   srgb   the same; codes are not linearised: those of 8 bits are multiples of 257
///   snorm  bits of an int16_t, -32767 to 32767
///   float  bits of a half float
using DecodedTexel = std::array<uint16_t, 4>;

/// Reduce a channel of 16 bits to 8, to the nearest.
constexpr uint8_t narrowUnorm(uint16_t channel)
{
    return static_cast<uint8_t>((channel * 255u + 32767u) / 65535u);
}

} // namespace hearth::formats
