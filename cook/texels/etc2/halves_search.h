// Searches the modes of ETC1: individual and differential halves of a block.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/etc2/paints.h"
#include "cook/texels/etc2/texel_set.h"

#include <array>
#include <cstdint>

namespace hearth::texels
{

/// Two halves, each a base colour and a table of modifiers.
struct HalvesSolution
{
    int32_t error = INT32_MAX;
    bool is_differential = false; ///< codes of 5 bits, the second -4 to 3 from the first; else of 4 bits
    bool is_flipped = false;      ///< the halves are top and bottom
    std::array<Rgb, 2> codes{};
    std::array<uint8_t, 2> tables{};

    int bits() const { return is_differential ? 5 : 4; }
};

/// Return the colours of a half.
Paints halfPaints(const Rgb& color, size_t table);

/// Find halves of little error.
HalvesSolution searchHalves(const Block8& block, const SearchTables& tables, Effort effort);

} // namespace hearth::texels
