// Tables of ETC2 and EAC that decoder and encoder share.
// Source: Khronos Data Format Specification 1.3, tables of chapters 21 and 22.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstdint>

namespace hearth::formats
{

/// [table][0 or 1]: lesser and greater distance of a sub-block's colours from its base colour, in codes of 8
/// bits. An index of 2 bits has the greater one if its low bit is set, and subtracts it if its high bit is.
inline constexpr std::array<std::array<uint8_t, 2>, 8> kEtcDistances{
    {{2, 8}, {5, 17}, {9, 29}, {13, 42}, {18, 60}, {24, 80}, {33, 106}, {47, 183}}};

/// Distances of the modes T and H, in codes of 8 bits.
inline constexpr std::array<uint8_t, 8> kEtcPaintDistances{3, 6, 11, 16, 23, 32, 41, 64};

/// [table][index of 3 bits]: EAC's modifiers of the base value.
inline constexpr std::array<std::array<int8_t, 8>, 16> kEacModifiers{{
    {-3, -6, -9, -15, 2, 5, 8, 14},
    {-3, -7, -10, -13, 2, 6, 9, 12},
    {-2, -5, -8, -13, 1, 4, 7, 12},
    {-2, -4, -6, -13, 1, 3, 5, 12},
    {-3, -6, -8, -12, 2, 5, 7, 11},
    {-3, -7, -9, -11, 2, 6, 8, 10},
    {-4, -7, -8, -11, 3, 6, 7, 10},
    {-3, -5, -8, -11, 2, 4, 7, 10},
    {-2, -6, -8, -10, 1, 5, 7, 9},
    {-2, -5, -8, -10, 1, 4, 7, 9},
    {-2, -4, -8, -10, 1, 3, 7, 9},
    {-2, -5, -7, -10, 1, 4, 6, 9},
    {-3, -4, -7, -10, 2, 3, 6, 9},
    {-1, -2, -3, -10, 0, 1, 2, 9},
    {-4, -6, -8, -9, 3, 5, 7, 8},
    {-3, -5, -7, -9, 2, 4, 6, 8},
}};

} // namespace hearth::formats
