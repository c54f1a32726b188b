// Layouts of the modes of BC6H, and the meaning of its numbers.
// Source: Khronos Data Format Specification 1.3, chapter 20 ("BPTC Compressed Texture Image Formats").
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hearth::formats
{

// clang-format off

/// Variable of a block of BC6H: red, green or blue of endpoint 0, 1 (subset 0), 2 or 3 (subset 1). Its value
/// is 3 * endpoint + channel.
enum class Bc6hVariable : uint8_t { r0, g0, b0, r1, g1, b1, r2, g2, b2, r3, g3, b3 };

/// Bits of a variable that follow each other in the block, from bit `first` of the variable, which comes
/// first, to bit `last`; downwards if `last` is less.
struct Bc6hField
{
    Bc6hVariable variable;
    uint8_t last;
    uint8_t first;
};

/// Mode of BC6H.
struct Bc6hMode
{
    uint8_t number;                    ///< first bits of the block: 2 if it is below 2, else 5
    bool transformed;                  ///< endpoints 1 to 3 are differences to endpoint 0
    uint8_t subsets;                   ///< of 2 the partition's number of 5 bits follows the fields
    uint8_t endpoint_bits;             ///< of each channel of endpoint 0, and of all if not transformed
    std::array<uint8_t, 3> delta_bits; ///< of the channels of the other endpoints
    uint8_t field_count;
    std::array<Bc6hField, 23> fields;  ///< after the mode's number
};

namespace detail
{

template <size_t kCount>
constexpr Bc6hMode bc6hMode(uint8_t number, bool transformed, uint8_t subsets, uint8_t endpoint_bits,
                            std::array<uint8_t, 3> delta_bits, const Bc6hField (&fields)[kCount])
{
    Bc6hMode mode{number, transformed, subsets, endpoint_bits, delta_bits, kCount, {}};
    for (size_t i = 0; i < kCount; ++i)
        mode.fields[i] = fields[i];
    return mode;
}

constexpr std::array<Bc6hMode, 14> bc6hModes()
{
    using enum Bc6hVariable;
    return {
        bc6hMode(0, true, 2, 10, {5, 5, 5},
                 {{g2, 4, 4}, {b2, 4, 4}, {b3, 4, 4}, {r0, 9, 0}, {g0, 9, 0}, {b0, 9, 0}, {r1, 4, 0},
                  {g3, 4, 4}, {g2, 3, 0}, {g1, 4, 0}, {b3, 0, 0}, {g3, 3, 0}, {b1, 4, 0}, {b3, 1, 1},
                  {b2, 3, 0}, {r2, 4, 0}, {b3, 2, 2}, {r3, 4, 0}, {b3, 3, 3}}),
        bc6hMode(1, true, 2, 7, {6, 6, 6},
                 {{g2, 5, 5}, {g3, 4, 4}, {g3, 5, 5}, {r0, 6, 0}, {b3, 0, 0}, {b3, 1, 1}, {b2, 4, 4},
                  {g0, 6, 0}, {b2, 5, 5}, {b3, 2, 2}, {g2, 4, 4}, {b0, 6, 0}, {b3, 3, 3}, {b3, 5, 5},
                  {b3, 4, 4}, {r1, 5, 0}, {g2, 3, 0}, {g1, 5, 0}, {g3, 3, 0}, {b1, 5, 0}, {b2, 3, 0},
                  {r2, 5, 0}, {r3, 5, 0}}),
        bc6hMode(2, true, 2, 11, {5, 4, 4},
                 {{r0, 9, 0}, {g0, 9, 0}, {b0, 9, 0}, {r1, 4, 0}, {r0, 10, 10}, {g2, 3, 0}, {g1, 3, 0},
                  {g0, 10, 10}, {b3, 0, 0}, {g3, 3, 0}, {b1, 3, 0}, {b0, 10, 10}, {b3, 1, 1}, {b2, 3, 0},
                  {r2, 4, 0}, {b3, 2, 2}, {r3, 4, 0}, {b3, 3, 3}}),
        bc6hMode(6, true, 2, 11, {4, 5, 4},
                 {{r0, 9, 0}, {g0, 9, 0}, {b0, 9, 0}, {r1, 3, 0}, {r0, 10, 10}, {g3, 4, 4}, {g2, 3, 0},
                  {g1, 4, 0}, {g0, 10, 10}, {g3, 3, 0}, {b1, 3, 0}, {b0, 10, 10}, {b3, 1, 1}, {b2, 3, 0},
                  {r2, 3, 0}, {b3, 0, 0}, {b3, 2, 2}, {r3, 3, 0}, {g2, 4, 4}, {b3, 3, 3}}),
        bc6hMode(10, true, 2, 11, {4, 4, 5},
                 {{r0, 9, 0}, {g0, 9, 0}, {b0, 9, 0}, {r1, 3, 0}, {r0, 10, 10}, {b2, 4, 4}, {g2, 3, 0},
                  {g1, 3, 0}, {g0, 10, 10}, {b3, 0, 0}, {g3, 3, 0}, {b1, 4, 0}, {b0, 10, 10}, {b2, 3, 0},
                  {r2, 3, 0}, {b3, 1, 1}, {b3, 2, 2}, {r3, 3, 0}, {b3, 4, 4}, {b3, 3, 3}}),
        bc6hMode(14, true, 2, 9, {5, 5, 5},
                 {{r0, 8, 0}, {b2, 4, 4}, {g0, 8, 0}, {g2, 4, 4}, {b0, 8, 0}, {b3, 4, 4}, {r1, 4, 0},
                  {g3, 4, 4}, {g2, 3, 0}, {g1, 4, 0}, {b3, 0, 0}, {g3, 3, 0}, {b1, 4, 0}, {b3, 1, 1},
                  {b2, 3, 0}, {r2, 4, 0}, {b3, 2, 2}, {r3, 4, 0}, {b3, 3, 3}}),
        bc6hMode(18, true, 2, 8, {6, 5, 5},
                 {{r0, 7, 0}, {g3, 4, 4}, {b2, 4, 4}, {g0, 7, 0}, {b3, 2, 2}, {g2, 4, 4}, {b0, 7, 0},
                  {b3, 3, 3}, {b3, 4, 4}, {r1, 5, 0}, {g2, 3, 0}, {g1, 4, 0}, {b3, 0, 0}, {g3, 3, 0},
                  {b1, 4, 0}, {b3, 1, 1}, {b2, 3, 0}, {r2, 5, 0}, {r3, 5, 0}}),
        bc6hMode(22, true, 2, 8, {5, 6, 5},
                 {{r0, 7, 0}, {b3, 0, 0}, {b2, 4, 4}, {g0, 7, 0}, {g2, 5, 5}, {g2, 4, 4}, {b0, 7, 0},
                  {g3, 5, 5}, {b3, 4, 4}, {r1, 4, 0}, {g3, 4, 4}, {g2, 3, 0}, {g1, 5, 0}, {g3, 3, 0},
                  {b1, 4, 0}, {b3, 1, 1}, {b2, 3, 0}, {r2, 4, 0}, {b3, 2, 2}, {r3, 4, 0}, {b3, 3, 3}}),
        bc6hMode(26, true, 2, 8, {5, 5, 6},
                 {{r0, 7, 0}, {b3, 1, 1}, {b2, 4, 4}, {g0, 7, 0}, {b2, 5, 5}, {g2, 4, 4}, {b0, 7, 0},
                  {b3, 5, 5}, {b3, 4, 4}, {r1, 4, 0}, {g3, 4, 4}, {g2, 3, 0}, {g1, 4, 0}, {b3, 0, 0},
                  {g3, 3, 0}, {b1, 5, 0}, {b2, 3, 0}, {r2, 4, 0}, {b3, 2, 2}, {r3, 4, 0}, {b3, 3, 3}}),
        bc6hMode(30, false, 2, 6, {6, 6, 6},
                 {{r0, 5, 0}, {g3, 4, 4}, {b3, 0, 0}, {b3, 1, 1}, {b2, 4, 4}, {g0, 5, 0}, {g2, 5, 5},
                  {b2, 5, 5}, {b3, 2, 2}, {g2, 4, 4}, {b0, 5, 0}, {g3, 5, 5}, {b3, 3, 3}, {b3, 5, 5},
                  {b3, 4, 4}, {r1, 5, 0}, {g2, 3, 0}, {g1, 5, 0}, {g3, 3, 0}, {b1, 5, 0}, {b2, 3, 0},
                  {r2, 5, 0}, {r3, 5, 0}}),
        bc6hMode(3, false, 1, 10, {10, 10, 10},
                 {{r0, 9, 0}, {g0, 9, 0}, {b0, 9, 0}, {r1, 9, 0}, {g1, 9, 0}, {b1, 9, 0}}),
        bc6hMode(7, true, 1, 11, {9, 9, 9},
                 {{r0, 9, 0}, {g0, 9, 0}, {b0, 9, 0}, {r1, 8, 0}, {r0, 10, 10}, {g1, 8, 0}, {g0, 10, 10},
                  {b1, 8, 0}, {b0, 10, 10}}),
        bc6hMode(11, true, 1, 12, {8, 8, 8},
                 {{r0, 9, 0}, {g0, 9, 0}, {b0, 9, 0}, {r1, 7, 0}, {r0, 10, 11}, {g1, 7, 0}, {g0, 10, 11},
                  {b1, 7, 0}, {b0, 10, 11}}),
        bc6hMode(15, true, 1, 16, {4, 4, 4},
                 {{r0, 9, 0}, {g0, 9, 0}, {b0, 9, 0}, {r1, 3, 0}, {r0, 10, 15}, {g1, 3, 0}, {g0, 10, 15},
                  {b1, 3, 0}, {b0, 10, 15}}),
    };
}

} // namespace detail

inline constexpr std::array<Bc6hMode, 14> kBc6hModes = detail::bc6hModes();

// clang-format on

/// Spread an endpoint's value of `bits` bits over 16 bits.
constexpr int32_t unquantizeBc6h(int32_t value, uint32_t bits, bool is_signed)
{
    if (!is_signed)
    {
        if (bits >= 15 || value == 0)
            return value;
        return value == (1 << bits) - 1 ? 0xFFFF : ((value << 15) + 0x4000) >> (bits - 1);
    }
    if (bits >= 16 || value == 0)
        return value;
    const int32_t size = value < 0 ? -value : value;
    const int32_t result = size >= (1 << (bits - 1)) - 1 ? 0x7FFF : ((size << 15) + 0x4000) >> (bits - 1);
    return value < 0 ? -result : result;
}

/// Return the half float of an interpolated value: sizes are scaled below those of infinity.
constexpr uint16_t bc6hHalf(int32_t value, bool is_signed)
{
    if (!is_signed)
        return static_cast<uint16_t>(value * 31 >> 6);
    if (value < 0)
        return static_cast<uint16_t>(-value * 31 >> 5 | 0x8000);
    return static_cast<uint16_t>(value * 31 >> 5);
}

} // namespace hearth::formats
