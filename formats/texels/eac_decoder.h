// Decodes EAC, the coding of single channels that ETC2's alpha has, too.
// Source: Khronos Data Format Specification 1.3, sections 21.5 and 22.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hearth::formats
{

/// Values of a 4x4 block, rows from top to bottom.
using EacValues = std::array<int, 16>;

/// Decode alpha: 0 to 255.
EacValues decodeEacAlpha(std::span<const std::byte, 8> block);

/// Decode an unsigned channel of 11 bits: 0 to 2047.
EacValues decodeEacUnsigned(std::span<const std::byte, 8> block);

/// Decode a signed channel of 11 bits: -1023 to 1023.
EacValues decodeEacSigned(std::span<const std::byte, 8> block);

/// Return 0 to 2047 as unorm of 16 bits: to the nearest.
constexpr uint16_t eacUnorm(int value)
{
    return static_cast<uint16_t>((value * 0xFFFF + 1023) / 2047);
}

/// Return -1023 to 1023 as the bits of snorm of 16 bits: to the nearest.
constexpr uint16_t eacSnorm(int value)
{
    const int magnitude = ((value < 0 ? -value : value) * 0x7FFF + 511) / 1023;
    return static_cast<uint16_t>(value < 0 ? -magnitude : magnitude);
}

} // namespace hearth::formats
