// Tests decoding of BC1 to BC5 against exact fractions, and of BC6H and BC7 with blocks made by hand.
// tests/runtime/gpu/texel_decode_test.cpp compares all modes with a device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/bc_decoder.h"
#include "tests/support/sanitized.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace hearth::test
{

namespace
{

using namespace formats;

using Block = std::array<std::byte, 16>;
using Texels = std::array<DecodedTexel, 16>;

Texels decode(TexelFormat format, const Block& block)
{
    const TexelFormatTraits& traits = texelTraits(format);
    Texels texels;
    decodeBcBlock(traits, std::span(block).first(traits.block_bytes), texels);
    return texels;
}

Block randomBlock(std::mt19937& random)
{
    Block block;
    for (std::byte& byte : block)
        byte = static_cast<std::byte>(random() & 255u);
    if (random() % 4 == 0) // the same endpoints, or the ends of the range
        for (size_t i = 0; i < 16; i += 8)
            block[i] = block[i + 1] = block[i + 2] = block[i + 3] =
                std::array{std::byte{0}, std::byte{0x80}, std::byte{0xFF}, std::byte{0x7F}}[random() % 4];
    return block;
}

uint32_t bitAt(const Block& block, size_t i)
{
    return std::to_integer<uint32_t>(block[i / 8]) >> i % 8 & 1u;
}

/// Return `count` bits, the lowest first.
uint32_t bitsAt(const Block& block, size_t first, size_t count)
{
    uint32_t value = 0;
    for (size_t i = 0; i < count; ++i)
        value |= bitAt(block, first + i) << i;
    return value;
}

void setBits(Block& block, size_t first, size_t count, uint32_t value)
{
    for (size_t i = 0; i < count; ++i)
        if ((value >> i & 1u) != 0)
            block[(first + i) / 8] |= static_cast<std::byte>(1u << (first + i) % 8);
}

/// Exact colours of BC1 as shares of 1, and alpha. `start` is the first bit of the colours.
std::array<double, 4> exactColor(const Block& block, size_t start, size_t texel, bool always_four)
{
    const uint32_t first = bitsAt(block, start, 16), second = bitsAt(block, start + 16, 16);
    const uint32_t code = bitsAt(block, start + 32 + 2 * texel, 2);
    const bool has_four = always_four || first > second;
    std::array<double, 4> color{0, 0, 0, 1};
    if (code == 3 && !has_four)
        return {0, 0, 0, 0};
    const double share = code == 0 ? 0 : code == 1 ? 1 : has_four ? (code == 2 ? 1 / 3.0 : 2 / 3.0) : 0.5;
    const size_t places[] = {11, 5, 0}, widths[] = {5, 6, 5};
    for (size_t c = 0; c < 3; ++c)
    {
        const double max = std::exp2(double(widths[c])) - 1;
        const double a = bitsAt(block, start + places[c], widths[c]) / max;
        const double b = bitsAt(block, start + 16 + places[c], widths[c]) / max;
        color[c] = a * (1 - share) + b * share;
    }
    return color;
}

/// Exact value of a channel of BC4 as a share of 1.
double exactChannel(const Block& block, size_t start, size_t texel, bool is_signed)
{
    const auto end = [&](size_t first)
    {
        const auto bits = static_cast<int>(bitsAt(block, first, 8));
        return is_signed && bits > 127 ? bits - 256 : bits;
    };
    const int a = end(start), b = end(start + 8);
    const auto code = static_cast<int>(bitsAt(block, start + 16 + 3 * texel, 3));
    const auto share = [&](int value) { return is_signed ? std::max(value / 127.0, -1.0) : value / 255.0; };
    if (code < 2)
        return share(code == 0 ? a : b);
    if (a > b)
        return share(a) * (8 - code) / 7 + share(b) * (code - 1) / 7;
    if (code >= 6)
        return code == 7 ? 1 : is_signed ? -1 : 0;
    return share(a) * (6 - code) / 5 + share(b) * (code - 1) / 5;
}

/// Largest difference of an 8-bit code to the exact colour: half a code, and a widened endpoint's.
constexpr double kColorError = (0.5 + 0.72) / 255;

} // namespace

TEST(BcDecoder, keepsColorsWithinACodeOfTheExactFraction)
{
    std::mt19937 random(1);
    for (size_t trial = 0; trial < trials(20000); ++trial)
    {
        const Block block = randomBlock(random);
        const Texels opaque = decode(TexelFormat::bc1_rgb_srgb, block);
        const Texels transparent = decode(TexelFormat::bc1_rgba_unorm, block);
        const Texels second = decode(TexelFormat::bc2_unorm, block);
        const Texels third = decode(TexelFormat::bc3_srgb, block);
        for (size_t t = 0; t < 16; ++t)
        {
            const std::array<double, 4> by_order = exactColor(block, 0, t, false);
            const std::array<double, 4> of_four = exactColor(block, 64, t, true);
            for (size_t c = 0; c < 3; ++c)
            {
                ASSERT_NEAR(opaque[t][c] / 65535.0, by_order[c], kColorError);
                ASSERT_EQ(opaque[t][c], transparent[t][c]);
                ASSERT_NEAR(second[t][c] / 65535.0, of_four[c], kColorError);
                ASSERT_EQ(second[t][c], third[t][c]);
                ASSERT_EQ(opaque[t][c] % 257, 0);
            }
            ASSERT_EQ(opaque[t][3], 0xFFFF);
            ASSERT_EQ(transparent[t][3], by_order[3] * 0xFFFF);
            ASSERT_EQ(second[t][3], bitsAt(block, 4 * t, 4) * 0x1111);
            ASSERT_NEAR(third[t][3] / 65535.0, exactChannel(block, 0, t, false), 0.501 / 255);
        }
    }
}

TEST(BcDecoder, roundsChannelsTo16Bits)
{
    std::mt19937 random(2);
    for (size_t trial = 0; trial < trials(20000); ++trial)
    {
        const Block block = randomBlock(random);
        const Texels one = decode(TexelFormat::bc4_unorm, block);
        const Texels two = decode(TexelFormat::bc5_unorm, block);
        const Texels two_signed = decode(TexelFormat::bc5_snorm, block);
        for (size_t t = 0; t < 16; ++t)
        {
            ASSERT_EQ(one[t], (DecodedTexel{two[t][0], 0, 0, 0xFFFF}));
            ASSERT_EQ(two_signed[t][2], 0);
            ASSERT_EQ(two_signed[t][3], 0x7FFF);
            for (size_t c = 0; c < 2; ++c)
            {
                ASSERT_NEAR(two[t][c], exactChannel(block, 64 * c, t, false) * 65535, 0.501);
                ASSERT_NEAR(static_cast<int16_t>(two_signed[t][c]),
                            exactChannel(block, 64 * c, t, true) * 32767, 0.501);
            }
        }
    }
}

TEST(BcDecoder, bc7ModeOfOneSubset)
{
    Block block{};
    setBits(block, 6, 1, 1);  // mode 6
    setBits(block, 7, 7, 10); // red of both ends
    setBits(block, 14, 7, 100);
    setBits(block, 49, 14, 0x3FFF); // alpha
    setBits(block, 63, 2, 2);       // lowest bits: 0, 1
    setBits(block, 65, 3, 5);       // texel 0 has 3 bits
    setBits(block, 68, 4, 15);
    const Texels texels = decode(TexelFormat::bc7_unorm, block);
    EXPECT_EQ(texels[0], (DecodedTexel{((64 - 21) * 20 + 21 * 201 + 32) / 64 * 257, 0, 0, 254 * 257}));
    EXPECT_EQ(texels[1], (DecodedTexel{201 * 257, 257, 257, 255 * 257}));
    EXPECT_EQ(texels[2], (DecodedTexel{20 * 257, 0, 0, 254 * 257}));
}

TEST(BcDecoder, bc7ModeOfTwoSubsets)
{
    Block block{};
    setBits(block, 1, 1, 1);          // mode 1
    setBits(block, 2, 6, 13);         // the lower half is subset 1
    setBits(block, 8, 6, 32);         // red of the first end
    setBits(block, 56, 24, 0xFFFFFF); // blue of all ends
    setBits(block, 68, 12, 0);
    setBits(block, 80, 2, 2); // lowest bits: 0 of subset 0, 1 of subset 1
    setBits(block, 82, 2, 3); // indices: texel 0 has 2 bits, as has texel 15
    setBits(block, 126, 2, 3);
    Texels texels = decode(TexelFormat::bc7_srgb, block);
    EXPECT_EQ(texels[1], (DecodedTexel{129 * 257, 0, 253 * 257, 0xFFFF}));
    EXPECT_EQ(texels[0], (DecodedTexel{((64 - 27) * 129 + 32) / 64 * 257, 0, 253 * 257, 0xFFFF}));
    EXPECT_EQ(texels[8], (DecodedTexel{2 * 257, 2 * 257, 255 * 257, 0xFFFF}));
    EXPECT_EQ(texels[15], texels[8]);
}

TEST(BcDecoder, bc7ExchangesChannelsAndIndices)
{
    Block block{};
    setBits(block, 4, 1, 1);   // mode 4
    setBits(block, 5, 2, 2);   // alpha and green change places
    setBits(block, 7, 1, 1);   // colours have the indices of 3 bits
    setBits(block, 13, 5, 31); // red of the second end
    setBits(block, 44, 6, 63); // alpha of the second end
    setBits(block, 51, 2, 2);  // texel 1 of the indices of 2 bits
    setBits(block, 83, 3, 1);  // texel 1 of those of 3 bits
    const Texels texels = decode(TexelFormat::bc7_unorm, block);
    EXPECT_EQ(texels[0], (DecodedTexel{}));
    EXPECT_EQ(texels[1], (DecodedTexel{(9 * 255 + 32) / 64 * 257, (43 * 255 + 32) / 64 * 257, 0, 0}));
}

TEST(BcDecoder, bc6hEndpointsAreWholeOrDifferences)
{
    Block block{};
    setBits(block, 0, 5, 3); // whole endpoints of 10 bits
    setBits(block, 5, 10, 512);
    setBits(block, 35, 10, 1023);
    setBits(block, 68, 4, 15); // texel 1
    Texels texels = decode(TexelFormat::bc6h_ufloat, block);
    const int unquantized = ((512 << 15) + 0x4000) >> 9;
    EXPECT_EQ(texels[0], (DecodedTexel{static_cast<uint16_t>(unquantized * 31 / 64), 0, 0, 0x3C00}));
    EXPECT_EQ(texels[1], (DecodedTexel{0x7BFF, 0, 0, 0x3C00}));

    block = {};
    setBits(block, 0, 5, 15); // 16 bits, and differences of 4 whose highest bits come in the other order
    setBits(block, 5, 10, 5);
    setBits(block, 39, 6, 0b100000); // bit 10 of red
    setBits(block, 35, 4, 0b1110);   // -2
    setBits(block, 68, 4, 15);
    texels = decode(TexelFormat::bc6h_sfloat, block);
    EXPECT_EQ(texels[0][0], (1024 + 5) * 31 / 32);
    EXPECT_EQ(texels[1][0], (1024 + 3) * 31 / 32);
}

TEST(BcDecoder, reservedModesAreBlack)
{
    std::mt19937 random(3);
    Block block = randomBlock(random);
    block[0] = std::byte{0};
    EXPECT_EQ(decode(TexelFormat::bc7_unorm, block), Texels{});
    for (const unsigned mode : {19u, 23u, 27u, 31u})
    {
        block[0] = static_cast<std::byte>(mode | 0xE0u);
        for (const DecodedTexel& texel : decode(TexelFormat::bc6h_sfloat, block))
            EXPECT_EQ(texel, (DecodedTexel{0, 0, 0, 0x3C00}));
    }
}

} // namespace hearth::test
