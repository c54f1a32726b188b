// Tests encoders of BC by their decoder: reported errors, exact cases, and references that are no search at
// all.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/bc/bc1.h"
#include "cook/texels/bc/bc4.h"
#include "cook/texels/bc/bc6h.h"
#include "cook/texels/bc/bc7.h"
#include "tests/support/sanitized.h"
#include "tests/texels/bc_blocks.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using namespace formats;
using namespace texels;

constexpr Effort kEfforts[] = {Effort::draft, Effort::normal, Effort::high};
constexpr uint16_t kMaxHalf = 0x7BFF;

template <size_t kBytes>
using Bytes = std::array<std::byte, kBytes>;

/// Return the error of colours that are all nearest to one of `steps` + 1 colours between the corners of the
/// block's bounding box. Corners are rounded to codes of `bits`.
uint64_t boxError(const Block8& block, size_t channels, int steps, const std::array<int, 4>& bits)
{
    std::array<std::array<int, 4>, 2> corners;
    for (size_t c = 0; c < channels; ++c)
    {
        uint8_t low = 255, high = 0;
        for (const auto& texel : block)
        {
            low = std::min(low, texel[c]);
            high = std::max(high, texel[c]);
        }
        const auto round = [&](uint8_t value)
        {
            const int code = static_cast<int>(std::lround(value * (std::exp2(bits[c]) - 1) / 255));
            return code << (8 - bits[c]) | code >> (2 * bits[c] - 8);
        };
        corners[0][c] = round(low);
        corners[1][c] = round(high);
    }
    uint64_t sum = 0;
    for (const auto& texel : block)
    {
        uint64_t best = UINT64_MAX;
        for (int k = 0; k <= steps; ++k)
        {
            uint64_t error = 0;
            for (size_t c = 0; c < channels; ++c)
            {
                const int color = (corners[0][c] * (steps - k) + corners[1][c] * k + steps / 2) / steps;
                error += static_cast<uint64_t>((color - texel[c]) * (color - texel[c]));
            }
            best = std::min(best, error);
        }
        sum += best;
    }
    return sum;
}

} // namespace

TEST(BcEncoder, reportsTheDecodedErrorOfBc1)
{
    std::mt19937 random(1);
    for (size_t trial = 0; trial < trials(400); ++trial)
    {
        const Block8 block = makeBlock(random, true);
        const auto weight = [&] { return static_cast<uint8_t>(random() % (kMaxChannelWeight + 1)); };
        const ChannelWeights weights = {weight(), weight(), weight(), 0};
        for (const Effort effort : kEfforts)
        {
            Bytes<16> bytes{}, again{};
            const uint32_t error =
                encodeBc1(block, weights, Bc1Palettes::all, effort, std::span(bytes).first<8>());
            EXPECT_EQ(error, sumErrors(decodeAs(TexelFormat::bc1_rgb_unorm, bytes), block, weights));
            encodeBc1(block, weights, Bc1Palettes::all, effort, std::span(again).first<8>());
            EXPECT_EQ(bytes, again);
            const uint32_t four =
                encodeBc1(block, weights, Bc1Palettes::four_only, effort, std::span(bytes).last<8>());
            EXPECT_EQ(four, sumErrors(decodeAs(TexelFormat::bc3_unorm, bytes), block, weights));
            EXPECT_LE(error, four);
        }
    }
}

TEST(BcEncoder, bc1IsBetterThanTheBoundingBox)
{
    std::mt19937 random(2);
    std::array<uint64_t, 3> sums{};
    uint64_t box = 0;
    for (size_t trial = 0; trial < trials(400); ++trial)
    {
        const Block8 block = makeBlock(random, false);
        const uint64_t reference = boxError(block, 3, 3, {5, 6, 5, 8});
        box += reference;
        for (size_t i = 0; i < 3; ++i)
        {
            Bytes<8> bytes;
            const uint32_t error = encodeBc1(block, {1, 1, 1, 0}, Bc1Palettes::all, kEfforts[i], bytes);
            if (kEfforts[i] != Effort::draft)
                EXPECT_LE(error, reference);
            sums[i] += error;
        }
    }
    EXPECT_LT(sums[0], box);
    EXPECT_LT(sums[1], sums[0]);
    EXPECT_LE(sums[2], sums[1]);
}

TEST(BcEncoder, bc1KeepsTwoOfItsColors)
{
    std::mt19937 random(3);
    for (size_t trial = 0; trial < trials(300); ++trial)
    {
        std::array<std::array<uint8_t, 4>, 2> colors;
        for (std::array<uint8_t, 4>& color : colors)
        {
            const uint32_t red = random() % 32, green = random() % 64, blue = random() % 32;
            color = {static_cast<uint8_t>(red << 3 | red >> 2), static_cast<uint8_t>(green << 2 | green >> 4),
                     static_cast<uint8_t>(blue << 3 | blue >> 2), 255};
        }
        const uint32_t pattern = trial % 3 == 0 ? 0 : static_cast<uint32_t>(random());
        Block8 block;
        for (size_t t = 0; t < 16; ++t)
            block[t] = colors[pattern >> t & 1u];
        Bytes<8> bytes;
        for (const Effort effort : kEfforts)
            EXPECT_EQ(encodeBc1(block, {1, 1, 1, 0}, Bc1Palettes::all, effort, bytes), 0u);
    }
}

TEST(BcEncoder, bc1UsesBlackBesideOtherColors)
{
    // four colours of a line far from black, and black
    Block8 block;
    for (size_t t = 0; t < 16; ++t)
        block[t] = t < 6    ? std::array<uint8_t, 4>{0, 0, 0, 255}
                   : t < 11 ? std::array<uint8_t, 4>{255, 0, 0, 255}
                            : std::array<uint8_t, 4>{0, 255, 255, 255};
    Bytes<8> bytes;
    EXPECT_EQ(encodeBc1(block, {1, 1, 1, 0}, Bc1Palettes::all, Effort::normal, bytes), 0u);
    EXPECT_GT(encodeBc1(block, {1, 1, 1, 0}, Bc1Palettes::four_only, Effort::normal, bytes), 0u);
}

TEST(BcEncoder, reportsTheDecodedErrorOfChannels)
{
    std::mt19937 random(4);
    for (size_t trial = 0; trial < trials(400); ++trial)
    {
        const Block8 block = makeBlock(random, true);
        const Block16 fine = makeBlock16(random, 65535);
        for (const Effort effort : kEfforts)
        {
            Bytes<16> bytes{}, again{};
            const uint32_t alpha = encodeBc3Alpha(block, effort, std::span(bytes).first<8>());
            EXPECT_EQ(alpha, sumErrors(decodeAs(TexelFormat::bc3_unorm, bytes), block, {0, 0, 0, 1}));
            const uint64_t one = encodeBc4(fine, 0, effort, std::span(bytes).first<8>());
            EXPECT_EQ(one, sumErrors16(decodeAs(TexelFormat::bc4_unorm, bytes), fine, 1));
            const uint64_t two = encodeBc5(fine, effort, bytes);
            EXPECT_EQ(two, sumErrors16(decodeAs(TexelFormat::bc5_unorm, bytes), fine, 2));
            encodeBc5(fine, effort, again);
            EXPECT_EQ(bytes, again);
            if (effort != Effort::draft)
                EXPECT_LE(alpha, boxError(Block8{[&]
                                                 {
                                                     Block8 gray = block;
                                                     for (auto& texel : gray)
                                                         texel[0] = texel[3];
                                                     return gray;
                                                 }()},
                                          1, 7, {8, 8, 8, 8}));
        }
    }
}

TEST(BcEncoder, channelsOfOneValueAreExactOrClose)
{
    for (uint32_t value = 0; value < 65536; value += 251)
    {
        Block16 block;
        block.fill({static_cast<uint16_t>(value), 0, 0, 0});
        Bytes<8> bytes;
        const uint64_t error = encodeBc4(block, 0, Effort::normal, bytes);
        // seven steps lie between two codes of 8 bits
        EXPECT_LE(error, 16u * 19 * 19) << value;
        if (value % 257 == 0)
            EXPECT_EQ(error, 0u);
    }
    Block8 opaque;
    opaque.fill({1, 2, 3, 255});
    Bytes<16> bytes{};
    for (const Effort effort : kEfforts)
    {
        EXPECT_EQ(encodeBc3Alpha(opaque, effort, std::span(bytes).first<8>()), 0u);
        for (const DecodedTexel& texel : decodeAs(TexelFormat::bc3_unorm, bytes))
            EXPECT_EQ(texel[3], 0xFFFF);
    }
}

TEST(BcEncoder, reportsTheDecodedErrorOfBc7)
{
    std::mt19937 random(5);
    std::array<uint32_t, 8> modes{};
    for (size_t trial = 0; trial < trials(600); ++trial)
    {
        const bool has_alpha = trial % 2 == 0;
        const Block8 block = makeBlock(random, has_alpha);
        const auto weight = [&] { return static_cast<uint8_t>(1 + random() % kMaxChannelWeight); };
        const ChannelWeights weights = trial % 3 == 0
                                           ? ChannelWeights{1, 1, 1, 1}
                                           : ChannelWeights{weight(), weight(), weight(), weight()};
        for (const Effort effort : kEfforts)
        {
            Bytes<16> bytes, again;
            const uint32_t error = encodeBc7(block, weights, effort, bytes);
            const auto decoded = decodeAs(TexelFormat::bc7_unorm, bytes);
            EXPECT_EQ(error, sumErrors(decoded, block, weights));
            encodeBc7(block, weights, effort, again);
            EXPECT_EQ(bytes, again);
            for (const DecodedTexel& texel : decoded)
                EXPECT_TRUE(has_alpha || texel[3] == 0xFFFF);
            ++modes[static_cast<size_t>(std::countr_zero(std::to_integer<uint8_t>(bytes[0])))];
        }
    }
    if (!kSanitized)
        for (size_t mode = 0; mode < 8; ++mode)
            EXPECT_GT(modes[mode], 0u) << mode;
}

TEST(BcEncoder, bc7IsBetterThanTheBoundingBox)
{
    std::mt19937 random(6);
    std::array<uint64_t, 3> sums{};
    for (size_t trial = 0; trial < trials(400); ++trial)
    {
        const bool has_alpha = trial % 2 == 0;
        const Block8 block = makeBlock(random, has_alpha);
        // indices of 4 bits, and endpoints of 7 bits: any lowest bit is better
        const uint64_t reference = boxError(block, has_alpha ? 4 : 3, 15, {7, 7, 7, 7});
        for (size_t i = 0; i < 3; ++i)
        {
            Bytes<16> bytes;
            const uint32_t error = encodeBc7(block, {1, 1, 1, 1}, kEfforts[i], bytes);
            EXPECT_LE(error, reference + 16);
            sums[i] += error;
        }
    }
    EXPECT_LT(sums[1], sums[0]);
    EXPECT_LT(sums[2], sums[1]);
}

TEST(BcEncoder, bc7IgnoresAlphaWithoutWeight)
{
    std::mt19937 random(7);
    for (size_t trial = 0; trial < trials(200); ++trial)
    {
        Block8 block = makeBlock(random, true);
        Bytes<16> bytes, opaque;
        encodeBc7(block, {1, 1, 1, 0}, Effort::normal, bytes);
        for (auto& texel : block)
            texel[3] = static_cast<uint8_t>(random());
        encodeBc7(block, {1, 1, 1, 0}, Effort::normal, opaque);
        EXPECT_EQ(bytes, opaque);
    }
}

TEST(BcEncoder, bc7KeepsOneColor)
{
    for (uint32_t value = 0; value < 256; ++value)
    {
        const auto v = static_cast<uint8_t>(value);
        Block8 block;
        block.fill(
            {v, static_cast<uint8_t>(v * 3), static_cast<uint8_t>(255 - v), static_cast<uint8_t>(v * 7)});
        Bytes<16> bytes;
        EXPECT_EQ(encodeBc7(block, {1, 1, 1, 1}, Effort::draft, bytes), 0u) << value;
        EXPECT_EQ(sumErrors(decodeAs(TexelFormat::bc7_unorm, bytes), block, {1, 1, 1, 1}), 0u) << value;
    }
}

TEST(BcEncoder, reportsTheDecodedErrorOfBc6h)
{
    std::mt19937 random(8);
    std::array<uint64_t, 3> sums{};
    for (size_t trial = 0; trial < trials(300); ++trial)
    {
        // also blocks with little contrast, for the modes that store differences
        Block16 block = makeBlock16(random, kMaxHalf);
        if (trial % 2 == 0)
            for (size_t t = 1; t < 16; ++t)
                for (size_t c = 0; c < 3; ++c)
                    block[t][c] = static_cast<uint16_t>(block[0][c] + (block[t][c] - block[0][c]) / 64);
        for (size_t i = 0; i < 3; ++i)
        {
            Bytes<16> bytes, again;
            const uint64_t error = encodeBc6h(block, kEfforts[i], bytes);
            EXPECT_EQ(error, sumErrors16(decodeAs(TexelFormat::bc6h_ufloat, bytes), block, 3));
            encodeBc6h(block, kEfforts[i], again);
            EXPECT_EQ(bytes, again);
            sums[i] += error;
        }
    }
    EXPECT_LT(sums[1], sums[0]);
    EXPECT_LT(sums[2], sums[1]);
}

TEST(BcEncoder, bc6hKeepsOneColorAndMakesOthersFinite)
{
    for (uint32_t half = 0; half <= kMaxHalf; half += 41)
    {
        Block16 block;
        block.fill({static_cast<uint16_t>(half), static_cast<uint16_t>(kMaxHalf - half), 0, 0});
        Bytes<16> bytes;
        EXPECT_EQ(encodeBc6h(block, Effort::draft, bytes), 0u) << half;
        EXPECT_EQ(sumErrors16(decodeAs(TexelFormat::bc6h_ufloat, bytes), block, 3), 0u) << half;
    }
    Block16 block;
    block.fill({0x7C00, 0xBC00, 0x7E00, 0}); // infinity, -1, NaN
    Bytes<16> bytes;
    encodeBc6h(block, Effort::normal, bytes);
    for (const DecodedTexel& texel : decodeAs(TexelFormat::bc6h_ufloat, bytes))
        EXPECT_EQ(texel, (DecodedTexel{kMaxHalf, 0, 0, 0x3C00}));
}

} // namespace hearth::test
