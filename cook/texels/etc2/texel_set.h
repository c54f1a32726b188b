// Texels of a part of a block, as the searches of ETC2's modes want them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/blocks/block_texels.h"
#include "cook/texels/etc2/search_tables.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace hearth::texels
{

/// Codes of 8 bits of red, green and blue; beyond 0 to 255 before clamping.
using Rgb = std::array<int32_t, 3>;

/// [texel in a row-major block]: whether a bit of a mask is set.
using TexelMask = uint32_t;

inline constexpr TexelMask kAllTexels = 0xFFFF;

/// Masks of the two halves: [is_flipped][second half].
inline constexpr std::array<std::array<TexelMask, 2>, 2> kHalfMasks{{{0x3333, 0xCCCC}, {0x00FF, 0xFF00}}};

/// Number of 1 to 16 texels and their sums.
struct TexelSet
{
    TexelSet(const Block8& block, TexelMask mask, const SearchTables& tables);

    /// Return the sum of weighted squares of differences from a colour.
    int32_t spread(const Rgb& color, const ColorWeights& weights) const
    {
        int32_t error = squares;
        for (size_t c = 0; c < 3; ++c)
            error += weights[c] * color[c] * (count * color[c] - 2 * sums[c]);
        return error;
    }

    int32_t count = 0;
    Rgb sums{};
    int32_t squares = 0;             ///< weighted
    std::array<int32_t, 16> grays{}; ///< [texel of the set]: weighted sum of channels
    int32_t min_gray = 0;
    int32_t max_gray = 0;
};

} // namespace hearth::texels
