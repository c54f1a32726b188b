// Layouts of the modes of BC7.
// Source: Khronos Data Format Specification 1.3, chapter 20 ("BPTC Compressed Texture Image Formats").
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstdint>

namespace hearth::formats
{

// clang-format off

/// Mode of BC7. Fields lie in the order of the members that count bits, after the mode's own bits.
struct Bc7Mode
{
    uint8_t subsets;
    uint8_t partition_bits;
    uint8_t rotation_bits;
    uint8_t selection_bits;    ///< 1: a bit exchanges the two sets of indices
    uint8_t color_bits;        ///< of a channel of an endpoint
    uint8_t alpha_bits;        ///< of an endpoint; 0: opaque
    uint8_t endpoint_p_bits;   ///< 1: each endpoint has a lowest bit, common to its channels
    uint8_t shared_p_bits;     ///< 1: each subset has one
    uint8_t index_bits;
    uint8_t second_index_bits; ///< 0: one set of indices
};

/// [mode]. Mode m starts with m zeros and a one.
inline constexpr std::array<Bc7Mode, 8> kBc7Modes = {{
    {3, 4, 0, 0, 4, 0, 1, 0, 3, 0},
    {2, 6, 0, 0, 6, 0, 0, 1, 3, 0},
    {3, 6, 0, 0, 5, 0, 0, 0, 2, 0},
    {2, 6, 0, 0, 7, 0, 1, 0, 2, 0},
    {1, 0, 2, 1, 5, 6, 0, 0, 2, 3},
    {1, 0, 2, 0, 7, 8, 0, 0, 2, 2},
    {1, 0, 0, 0, 7, 7, 1, 0, 4, 0},
    {2, 6, 0, 0, 5, 5, 1, 0, 2, 0},
}};

// clang-format on

} // namespace hearth::formats
