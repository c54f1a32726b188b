// Enumerates the base colours that can be best for a set of texels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/etc2/texel_set.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace hearth::texels
{

/// Widen a code of 4 to 7 bits to 8.
constexpr int32_t widenCode(int32_t code, int bits)
{
    return code << (8 - bits) | code >> (2 * bits - 8);
}

inline Rgb widenCodes(const Rgb& codes, int bits)
{
    return {widenCode(codes[0], bits), widenCode(codes[1], bits), widenCode(codes[2], bits)};
}

/// Return the code whose value is next to sum / count; the greater of two.
inline int32_t nearestCode(int32_t sum, int32_t count, int bits)
{
    const int32_t maximum = (1 << bits) - 1;
    int32_t code = std::clamp((sum * maximum + 127 * count) / (255 * count), 0, maximum);
    // the widened codes are not quite even
    const auto twiceMiddle = [&](int32_t low) { return widenCode(low, bits) + widenCode(low + 1, bits); };
    while (code < maximum && 2 * sum >= count * twiceMiddle(code))
        ++code;
    while (code > 0 && 2 * sum < count * twiceMiddle(code - 1))
        --code;
    return code;
}

/// No channel pinned.
inline constexpr Rgb kAllMove{-1, -1, -1};

/// Visit the base colours next to the line of grays through the mean, from the brightest to the darkest.
///
/// For given indices the best base colour is the mean of texels less their modifiers; a modifier is the same
/// in all channels, so that the best is the mean, less one number, rounded. This visits the result of every
/// number in -reach to reach.
///
/// bits    of a code: 4 or 5
/// pinned  codes of channels that stay as they are; -1: the channel moves with the others
/// visit   called with the codes (Rgb)
template <typename Visit>
void sweepBases(const TexelSet& set, int bits, int32_t reach, const Rgb& pinned, Visit visit)
{
    // all numbers are scaled by 2 count
    const int32_t scale = 2 * set.count;
    Rgb codes;
    std::array<int32_t, 3> next; // number from which on a channel has a lower code
    const auto findNext = [&](size_t c)
    {
        const int32_t code = codes[c];
        return code == 0 || pinned[c] >= 0
                   ? INT32_MAX
                   : 2 * set.sums[c] - set.count * (widenCode(code, bits) + widenCode(code - 1, bits));
    };
    for (size_t c = 0; c < 3; ++c)
    {
        codes[c] = pinned[c] >= 0
                       ? pinned[c]
                       : nearestCode(std::max(set.sums[c] + set.count * reach, 0), set.count, bits);
        next[c] = findNext(c);
    }
    for (;;)
    {
        visit(codes);
        const size_t c = next[0] <= next[1] ? (next[0] <= next[2] ? 0 : 2) : (next[1] <= next[2] ? 1 : 2);
        if (next[c] > scale * reach)
            return;
        --codes[c];
        next[c] = findNext(c);
    }
}

} // namespace hearth::texels
