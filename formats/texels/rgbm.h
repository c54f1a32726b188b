// Colours of four bytes: the square roots of three channels as fractions of a fourth, their common factor.
// Source: X. Guo and T. Li, "Practical High-Performance Rendering on Mobile Platforms", GDC 2023:
// (6 q m)^2, from 0 to 36.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstdint>

namespace hearth::formats
{

/// Largest value of a channel.
inline constexpr double kMaxRgbmValue = 36;

/// Encode a colour as bytes r, g, b, m, the first in the lowest bits. Negative channels become 0, those
/// beyond kMaxRgbmValue become it. Where the largest channel is 0.01 or more, no channel is off by more than
/// 0.52 % of the largest; there is no bias towards dark or bright.
uint32_t encodeRgbm(const std::array<double, 3>& color);

} // namespace hearth::formats
