// Exact errors of a block's texels by the four colours that indices choose from.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/etc2/texel_set.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace hearth::texels
{

/// Channels of texels apart, so that a compiler handles many at once.
template <size_t count>
struct ChannelTexels
{
    std::array<std::array<int16_t, count>, 3> channels;
};

/// [index of 2 bits]: colour, clamped.
using Paints = std::array<std::array<int16_t, 3>, 4>;

/// Return the paints of base colours and their modifiers.
inline Paints makePaints(const std::array<Rgb, 4>& bases, const std::array<int32_t, 4>& modifiers)
{
    Paints paints;
    for (size_t p = 0; p < 4; ++p)
        for (size_t c = 0; c < 3; ++c)
            paints[p][c] = static_cast<int16_t>(std::clamp(bases[p][c] + modifiers[p], 0, 255));
    return paints;
}

/// Gather the texels of a mask with `count` bits, in the order of rows.
template <size_t count>
ChannelTexels<count> gatherTexels(const Block8& block, TexelMask mask)
{
    ChannelTexels<count> texels;
    size_t gathered = 0;
    for (size_t t = 0; t < 16; ++t)
    {
        if ((mask >> t & 1) == 0)
            continue;
        for (size_t c = 0; c < 3; ++c)
            texels.channels[c][gathered] = block[t][c];
        ++gathered;
    }
    return texels;
}

/// Return each texel's least error.
template <size_t count>
std::array<int32_t, count> paintErrors(const ChannelTexels<count>& texels, const Paints& paints,
                                       const ColorWeights& weights)
{
    std::array<int32_t, count> best;
    best.fill(INT32_MAX);
    for (const std::array<int16_t, 3>& paint : paints)
        for (size_t t = 0; t < count; ++t)
        {
            int32_t error = 0;
            for (size_t c = 0; c < 3; ++c)
            {
                const auto difference = static_cast<int16_t>(texels.channels[c][t] - paint[c]);
                const auto weighted = static_cast<int16_t>(difference * weights[c]);
                error += int32_t{difference} * int32_t{weighted};
            }
            best[t] = std::min(best[t], error);
        }
    return best;
}

/// Return the sum of the texels' least errors.
template <size_t count>
int32_t paintError(const ChannelTexels<count>& texels, const Paints& paints, const ColorWeights& weights)
{
    int32_t sum = 0;
    for (const int32_t error : paintErrors(texels, paints, weights))
        sum += error;
    return sum;
}

/// Choose each texel's best paint.
/// returns  [texel]: index of 2 bits; the first of equal ones
template <size_t count>
std::array<uint8_t, count> choosePaints(const ChannelTexels<count>& texels, const Paints& paints,
                                        const ColorWeights& weights)
{
    std::array<uint8_t, count> indices;
    for (size_t t = 0; t < count; ++t)
    {
        int32_t best = INT32_MAX;
        for (size_t p = 0; p < 4; ++p)
        {
            int32_t error = 0;
            for (size_t c = 0; c < 3; ++c)
            {
                const int32_t difference = texels.channels[c][t] - paints[p][c];
                error += difference * difference * weights[c];
            }
            if (error < best)
            {
                best = error;
                indices[t] = static_cast<uint8_t>(p);
            }
        }
    }
    return indices;
}

} // namespace hearth::texels
