// 16-bit floating point (IEEE 754 half), as RGBA16F images store it: conversions round to nearest even.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <bit>
#include <cstdint>

namespace hearth
{

inline constexpr float kHalfMax = 65504.0f;
inline constexpr uint16_t kHalfOne = 0x3C00; ///< 1 as a half

/// Return the half nearest to `value`. Values outside the range become +-65504 and NaN becomes 0: a stored
/// image is finite.
constexpr uint16_t halfFromFloat(float value)
{
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    const uint32_t sign = (bits >> 16) & 0x8000u;
    const uint32_t magnitude = bits & 0x7FFFFFFFu;
    if (magnitude > 0x7F800000u)
        return 0;
    if (magnitude >= 0x477FE000u) // 65504 and above, infinity too
        return static_cast<uint16_t>(sign | 0x7BFFu);
    if (magnitude < 0x38800000u) // below 2^-14: a multiple of 2^-24
    {
        if (magnitude < 0x33000000u) // below 2^-25: rounds to zero
            return static_cast<uint16_t>(sign);
        const uint32_t shift = 126u - (magnitude >> 23);
        const uint32_t mantissa = (magnitude & 0x7FFFFFu) | 0x800000u;
        const uint32_t half = mantissa >> shift;
        const uint32_t rest = mantissa & ((1u << shift) - 1u);
        const uint32_t middle = 1u << (shift - 1u);
        return static_cast<uint16_t>(sign |
                                     (half + ((rest > middle || (rest == middle && (half & 1u))) ? 1u : 0u)));
    }
    const uint32_t half = (magnitude - 0x38000000u) >> 13;
    const uint32_t rest = magnitude & 0x1FFFu;
    return static_cast<uint16_t>(sign |
                                 (half + ((rest > 0x1000u || (rest == 0x1000u && (half & 1u))) ? 1u : 0u)));
}

constexpr float floatFromHalf(uint16_t half)
{
    const uint32_t sign = (half & 0x8000u) << 16;
    const uint32_t exponent = (half >> 10) & 31u;
    const uint32_t mantissa = half & 0x3FFu;
    if (exponent == 31)
        return std::bit_cast<float>(sign | 0x7F800000u | mantissa << 13);
    if (exponent != 0)
        return std::bit_cast<float>(sign | (exponent + 112u) << 23 | mantissa << 13);
    const float small = static_cast<float>(mantissa) * 0x1p-24f;
    return sign != 0 ? -small : small;
}

} // namespace hearth
