// Texels of RGB9E5: three mantissas of 9 bits with a shared exponent.
// Source: Vulkan 1.3, sections 39.3 (E5B9G9R9) and "RGB to shared exponent".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstdint>

namespace hearth::formats
{

/// Largest value of a channel: mantissa 511 with the largest exponent.
inline constexpr double kMaxSharedExponentValue = 65408;

/// Encode a colour; each channel is rounded to the nearest step of the largest one's exponent. Negative
/// channels become 0, those beyond kMaxSharedExponentValue become it.
uint32_t encodeSharedExponent(const std::array<double, 3>& color);

/// Decode a colour, without rounding.
std::array<float, 3> decodeSharedExponent(uint32_t word);

} // namespace hearth::formats
