// Blocks of texels of many kinds, and errors of encoded ones, for tests of encoders of BC.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/bc/channel_weights.h"
#include "cook/texels/blocks/block_texels.h"
#include "formats/texels/bc_decoder.h"

#include <random>

namespace hearth::test
{

inline uint8_t clampToByte(int value)
{
    return static_cast<uint8_t>(std::clamp(value, 0, 255));
}

/// Make a block: noise, a gradient with noise, two or three clusters of colours, nearly one colour, nearly
/// black.
inline texels::Block8 makeBlock(std::mt19937& random, bool has_alpha)
{
    const auto upTo = [&](uint32_t max) { return static_cast<int>(random() % (max + 1)); };
    const int kind = upTo(5);
    const int noise = std::array{255, 8, 3, 12, 2, 20}[static_cast<size_t>(kind)];
    std::array<std::array<int, 4>, 3> colors;
    for (std::array<int, 4>& color : colors)
        for (int& channel : color)
            channel = kind == 5 ? 0 : upTo(255);
    const int angle = upTo(4);
    texels::Block8 block;
    for (int t = 0; t < 16; ++t)
    {
        const int along = angle * (t % 4) + (4 - angle) * (t / 4); // 0 to 12
        const auto cluster = static_cast<size_t>(kind < 2 || kind == 4 ? 0 : upTo(kind == 2 ? 1u : 2u));
        for (size_t c = 0; c < 4; ++c)
        {
            const int base =
                kind == 1 ? (colors[0][c] * along + colors[1][c] * (12 - along)) / 12 : colors[cluster][c];
            block[static_cast<size_t>(t)][c] =
                clampToByte(base + upTo(static_cast<uint32_t>(noise)) - noise / 2);
        }
        if (!has_alpha)
            block[static_cast<size_t>(t)][3] = 255;
    }
    return block;
}

/// Make the same with 16 bits a channel.
inline texels::Block16 makeBlock16(std::mt19937& random, uint32_t max)
{
    const texels::Block8 coarse = makeBlock(random, true);
    texels::Block16 block;
    for (size_t t = 0; t < 16; ++t)
        for (size_t c = 0; c < 4; ++c)
            block[t][c] =
                static_cast<uint16_t>((uint32_t{coarse[t][c]} << 8 | (random() & 255u)) * max / 65535);
    return block;
}

/// Decode a block of a format.
inline std::array<formats::DecodedTexel, 16> decodeAs(formats::TexelFormat format,
                                                      std::span<const std::byte> block)
{
    std::array<formats::DecodedTexel, 16> texels;
    formats::decodeBcBlock(formats::texelTraits(format), block, texels);
    return texels;
}

/// Sum up the weighted squares of the differences between decoded texels and their source, in codes of 8
/// bits.
inline uint64_t sumErrors(std::span<const formats::DecodedTexel, 16> decoded, const texels::Block8& source,
                          const texels::ChannelWeights& weights)
{
    uint64_t sum = 0;
    for (size_t t = 0; t < 16; ++t)
        for (size_t c = 0; c < 4; ++c)
        {
            const int d = decoded[t][c] / 257 - source[t][c];
            sum += static_cast<uint64_t>(d * d) * weights[c];
        }
    return sum;
}

/// Sum up the squares of the differences in the first channels, as codes of 16 bits.
inline uint64_t sumErrors16(std::span<const formats::DecodedTexel, 16> decoded, const texels::Block16& source,
                            size_t channels)
{
    uint64_t sum = 0;
    for (size_t t = 0; t < 16; ++t)
        for (size_t c = 0; c < channels; ++c)
        {
            const int64_t d = decoded[t][c] - source[t][c];
            sum += static_cast<uint64_t>(d * d);
        }
    return sum;
}

} // namespace hearth::test
