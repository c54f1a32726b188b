// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/bc7_decoder.h"

#include "formats/texels/bc7_modes.h"
#include "formats/texels/block_bits.h"
#include "formats/texels/bptc_tables.h"

#include <algorithm>
#include <bit>

namespace hearth::formats
{

namespace
{

/// [2 * subset + end][channel]: codes of 8 bits.
using Endpoints = std::array<std::array<uint32_t, 4>, 6>;

/// Widen a value of 5 to 8 bits to 8 by repeating its highest bits below.
uint32_t repeatHighBits(uint32_t value, uint32_t bits)
{
    return value << (8 - bits) | value >> (2 * bits - 8);
}

Endpoints readEndpoints(const Bc7Mode& mode, BlockBitReader& bits)
{
    const uint32_t count = mode.subsets * 2u;
    Endpoints ends{};
    for (uint32_t channel = 0; channel < 4; ++channel)
        for (uint32_t i = 0; i < count; ++i)
            ends[i][channel] = bits.read(channel < 3 ? mode.color_bits : mode.alpha_bits);
    std::array<uint32_t, 6> lowest{}; // P-bits by endpoint
    if (mode.endpoint_p_bits != 0)
        for (uint32_t i = 0; i < count; ++i)
            lowest[i] = bits.read(1);
    if (mode.shared_p_bits != 0)
        for (uint32_t i = 0; i < count; i += 2)
            lowest[i] = lowest[i + 1] = bits.read(1);
    const uint32_t more = mode.endpoint_p_bits + mode.shared_p_bits;
    for (uint32_t i = 0; i < count; ++i)
        for (uint32_t channel = 0; channel < 4; ++channel)
        {
            const uint32_t width = channel < 3 ? mode.color_bits : mode.alpha_bits;
            ends[i][channel] =
                width == 0 ? 255u : repeatHighBits(ends[i][channel] << more | lowest[i], width + more);
        }
    return ends;
}

} // namespace

void decodeBc7Block(std::span<const std::byte, 16> block, std::span<DecodedTexel, 16> texels)
{
    const auto number = static_cast<uint32_t>(std::countr_zero(std::to_integer<uint8_t>(block[0])));
    if (number >= kBc7Modes.size())
    {
        std::fill(texels.begin(), texels.end(), DecodedTexel{});
        return;
    }
    const Bc7Mode& mode = kBc7Modes[number];
    BlockBitReader bits(block);
    bits.read(number + 1);
    const uint32_t partition = bits.read(mode.partition_bits);
    const uint32_t rotation = bits.read(mode.rotation_bits);
    const uint32_t selection = bits.read(mode.selection_bits);
    const Endpoints ends = readEndpoints(mode, bits);

    std::array<std::array<uint32_t, 16>, 2> weights{}; // of the first and the second indices
    for (uint32_t set = 0; set < 2; ++set)
    {
        const uint32_t width = set == 0 ? mode.index_bits : mode.second_index_bits;
        for (uint32_t t = 0; width != 0 && t < 16; ++t)
        {
            const uint32_t subset = bptcSubset(mode.subsets, partition, t);
            const bool is_anchor = t == bptcAnchor(mode.subsets, partition, subset);
            weights[set][t] = bptcWeight(bits.read(width - (is_anchor ? 1 : 0)), width);
        }
    }
    const uint32_t color_set = selection;
    const uint32_t alpha_set = mode.second_index_bits != 0 ? 1 - selection : 0;
    for (uint32_t t = 0; t < 16; ++t)
    {
        const uint32_t first = 2 * bptcSubset(mode.subsets, partition, t);
        for (uint32_t channel = 0; channel < 4; ++channel)
        {
            const uint32_t weight = weights[channel < 3 ? color_set : alpha_set][t];
            const uint32_t code =
                ((64 - weight) * ends[first][channel] + weight * ends[first + 1][channel] + 32) >> 6;
            texels[t][channel] = static_cast<uint16_t>(code * 257);
        }
        if (rotation != 0)
            std::swap(texels[t][3], texels[t][rotation - 1]);
    }
}

} // namespace hearth::formats
