// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/etc2_decoder.h"

#include "formats/texels/eac_decoder.h"
#include "tests/support/sanitized.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace hearth::formats
{

namespace
{

using test::trials;

using Bytes8 = std::array<std::byte, 8>;
using Texels = std::array<DecodedTexel, 16>;

/// Return a block by its bits as the specification numbers them.
Bytes8 blockFromBits(uint64_t word)
{
    Bytes8 bytes;
    for (size_t b = 0; b < 8; ++b)
        bytes[b] = static_cast<std::byte>(word >> (56 - 8 * b));
    return bytes;
}

/// Return a value in the bits from `low` on.
uint64_t at(uint32_t low, uint64_t value)
{
    return value << low;
}

Texels decode(TexelFormat format, std::span<const std::byte> block)
{
    Texels texels;
    decodeEtc2Block(texelTraits(format), block, texels);
    return texels;
}

Texels decodeColors(uint64_t word, TexelFormat format = TexelFormat::etc2_rgb8_unorm)
{
    return decode(format, blockFromBits(word));
}

DecodedTexel opaque(int red, int green, int blue)
{
    const auto widen = [](int code) { return static_cast<uint16_t>(code * 257); };
    return {widen(red), widen(green), widen(blue), 0xFFFF};
}

constexpr DecodedTexel kTransparent{};

// Indices 0 to 3 from top to bottom in the left column, 0 elsewhere.
constexpr uint64_t kColumn = 1 << 1 | 1 << 18 | 1 << 19 | 1 << 3;
constexpr uint64_t kDifferentialBit = uint64_t{1} << 33;
constexpr uint64_t kFlipBit = uint64_t{1} << 32;

TEST(Etc2Decoder, individualHalves)
{
    // 8, 4, 0 with table 0 and 0, 15, 1 with table 7
    const uint64_t word = at(60, 8) | at(56, 0) | at(52, 4) | at(48, 15) | at(44, 0) | at(40, 1) | at(37, 0) |
                          at(34, 7) | kColumn;
    const Texels upright = decodeColors(word);
    EXPECT_EQ(upright[0], opaque(138, 70, 2));
    EXPECT_EQ(upright[4], opaque(144, 76, 8));
    EXPECT_EQ(upright[8], opaque(134, 66, 0));
    EXPECT_EQ(upright[12], opaque(128, 60, 0));
    EXPECT_EQ(upright[1], opaque(138, 70, 2));
    EXPECT_EQ(upright[2], opaque(47, 255, 64));
    EXPECT_EQ(upright[15], opaque(47, 255, 64));

    const Texels flipped = decodeColors(word | kFlipBit);
    EXPECT_EQ(flipped[3], opaque(138, 70, 2));
    EXPECT_EQ(flipped[4], opaque(144, 76, 8));
    EXPECT_EQ(flipped[8], opaque(0, 208, 0)); // index 2: 17 - 47 and so on
    EXPECT_EQ(flipped[12], opaque(0, 72, 0)); // index 3
    EXPECT_EQ(flipped[15], opaque(47, 255, 64));
}

TEST(Etc2Decoder, differentialHalves)
{
    // 31, 16, 0 and 27, 19, 0; tables 1 and 2
    const uint64_t word =
        at(59, 31) | at(56, 4) | at(51, 16) | at(48, 3) | at(37, 1) | at(34, 2) | kDifferentialBit | kColumn;
    const Texels texels = decodeColors(word);
    EXPECT_EQ(texels[0], opaque(255, 137, 5));
    EXPECT_EQ(texels[4], opaque(255, 149, 17));
    EXPECT_EQ(texels[8], opaque(250, 127, 0));
    EXPECT_EQ(texels[12], opaque(238, 115, 0));
    EXPECT_EQ(texels[3], opaque(231, 165, 9));
}

TEST(Etc2Decoder, modeT)
{
    // 11, 2, 0 alone; 1, 8, 15 at distance 32; red overflows: 30 + 3
    const uint64_t word = at(61, 7) | at(59, 2) | at(56, 3) | at(52, 2) | at(48, 0) | at(44, 1) | at(40, 8) |
                          at(36, 15) | at(34, 2) | at(32, 1) | kDifferentialBit | kColumn;
    const Texels texels = decodeColors(word);
    EXPECT_EQ(texels[0], opaque(187, 34, 0));
    EXPECT_EQ(texels[4], opaque(49, 168, 255));
    EXPECT_EQ(texels[8], opaque(17, 136, 255));
    EXPECT_EQ(texels[12], opaque(0, 104, 223));
    EXPECT_EQ(texels[15], opaque(187, 34, 0));
}

TEST(Etc2Decoder, modeHHasABitInTheOrderOfItsColours)
{
    // 9, 5, 14 and 3, 3, 3; green overflows: 31 + 3
    const uint64_t falling = at(59, 9) | at(56, 2) | at(53, 7) | at(52, 1) | at(51, 1) | at(47, 6) |
                             at(43, 3) | at(39, 3) | at(35, 3) | at(34, 1) | kDifferentialBit | kColumn;
    const Texels texels = decodeColors(falling); // distance 32
    EXPECT_EQ(texels[0], opaque(185, 117, 255));
    EXPECT_EQ(texels[4], opaque(121, 53, 206));
    EXPECT_EQ(texels[8], opaque(83, 83, 83));
    EXPECT_EQ(texels[12], opaque(19, 19, 19));

    // 3, 3, 3 and 9, 5, 14; green overflows: 2 - 3
    const uint64_t rising = at(59, 3) | at(56, 1) | at(52, 1) | at(51, 0) | at(50, 1) | at(47, 3) |
                            at(43, 9) | at(39, 5) | at(35, 14) | at(34, 1) | kDifferentialBit | kColumn;
    const Texels other = decodeColors(rising); // distance 23
    EXPECT_EQ(other[0], opaque(74, 74, 74));
    EXPECT_EQ(other[4], opaque(28, 28, 28));
    EXPECT_EQ(other[8], opaque(176, 108, 255));
    EXPECT_EQ(other[12], opaque(130, 62, 215));

    // 3, 3, 3 twice counts as falling: distance 32
    const uint64_t equal = at(59, 3) | at(56, 1) | at(52, 1) | at(50, 1) | at(47, 3) | at(43, 3) | at(39, 3) |
                           at(35, 3) | at(34, 1) | kDifferentialBit | kColumn;
    EXPECT_EQ(decodeColors(equal)[0], opaque(83, 83, 83));
}

TEST(Etc2Decoder, planar)
{
    // origin 21, 64, 32; right 63, 0, 32; below 21, 127, 0; blue overflows: 0 - 4
    const uint64_t word = at(57, 21) | at(56, 1) | at(48, 1) | at(42, 1) | at(34, 31) | at(32, 1) |
                          at(25, 0) | at(19, 32) | at(13, 21) | at(6, 127) | at(0, 0) | kDifferentialBit;
    for (const TexelFormat format : {TexelFormat::etc2_rgb8_unorm, TexelFormat::etc2_rgb8a1_unorm})
    {
        const Texels texels = decodeColors(word, format);
        EXPECT_EQ(texels[0], opaque(85, 129, 130));
        EXPECT_EQ(texels[9], opaque(128, 160, 65));
        EXPECT_EQ(texels[15], opaque(213, 127, 33));
    }
    // the bit of the mode says nothing of planar texels where it means "opaque"
    EXPECT_EQ(decodeColors(word & ~kDifferentialBit, TexelFormat::etc2_rgb8a1_unorm),
              decodeColors(word, TexelFormat::etc2_rgb8a1_unorm));
}

TEST(Etc2Decoder, punchedTexels)
{
    constexpr TexelFormat kPunched = TexelFormat::etc2_rgb8a1_unorm;
    const uint64_t halves = at(59, 10) | at(51, 10) | at(43, 10) | at(37, 1) | kColumn;
    EXPECT_EQ(decodeColors(halves | kDifferentialBit, kPunched), decodeColors(halves | kDifferentialBit));
    const Texels texels = decodeColors(halves, kPunched);
    EXPECT_EQ(texels[0], opaque(82, 82, 82)); // without the lesser distance
    EXPECT_EQ(texels[4], opaque(99, 99, 99));
    EXPECT_EQ(texels[8], kTransparent);
    EXPECT_EQ(texels[12], opaque(65, 65, 65));

    const uint64_t mode_t = at(61, 7) | at(59, 2) | at(56, 3) | at(52, 2) | at(40, 8) | at(34, 2) | kColumn;
    const Texels t = decodeColors(mode_t, kPunched);
    EXPECT_EQ(t[0], opaque(187, 34, 0));
    EXPECT_EQ(t[4], opaque(23, 159, 23));
    EXPECT_EQ(t[8], kTransparent);
    EXPECT_EQ(t[12], opaque(0, 113, 0));
}

// Indices 3 and 7 in the first two rows of the left column, 4 elsewhere.
constexpr uint64_t kEacIndices = 03744444444444444;

TEST(EacDecoder, alpha)
{
    const EacValues values = decodeEacAlpha(blockFromBits(at(56, 100) | at(52, 2) | at(48, 3) | kEacIndices));
    EXPECT_EQ(values[0], 100 - 2 * 13);
    EXPECT_EQ(values[4], 100 + 2 * 12);
    EXPECT_EQ(values[1], 100 + 2 * 1);
    EXPECT_EQ(values[15], 100 + 2 * 1);
    const EacValues flat = decodeEacAlpha(blockFromBits(at(56, 100) | at(48, 3) | kEacIndices));
    EXPECT_EQ(flat[0], 100);
    EXPECT_EQ(flat[4], 100);
    const EacValues low = decodeEacAlpha(blockFromBits(at(56, 20) | at(52, 15) | at(48, 3) | kEacIndices));
    EXPECT_EQ(low[0], 0);
    const EacValues high = decodeEacAlpha(blockFromBits(at(56, 250) | at(52, 15) | at(48, 3) | kEacIndices));
    EXPECT_EQ(high[4], 255);
}

TEST(EacDecoder, unsignedChannel)
{
    const EacValues coarse =
        decodeEacUnsigned(blockFromBits(at(56, 100) | at(52, 2) | at(48, 3) | kEacIndices));
    EXPECT_EQ(coarse[0], 804 - 16 * 13);
    EXPECT_EQ(coarse[4], 804 + 16 * 12);
    EXPECT_EQ(coarse[15], 804 + 16);
    const EacValues fine = decodeEacUnsigned(blockFromBits(at(56, 100) | at(48, 3) | kEacIndices));
    EXPECT_EQ(fine[0], 804 - 13);
    EXPECT_EQ(fine[4], 804 + 12);
    const EacValues ends = decodeEacUnsigned(blockFromBits(at(52, 15) | at(48, 3) | kEacIndices));
    EXPECT_EQ(ends[0], 0);
    EXPECT_EQ(ends[4], 4 + 120 * 12);
}

TEST(EacDecoder, signedChannel)
{
    for (const uint64_t lowest : {0x80u, 0x81u}) // -128 is -127
    {
        const EacValues values =
            decodeEacSigned(blockFromBits(at(56, lowest) | at(52, 15) | at(48, 3) | kEacIndices));
        EXPECT_EQ(values[0], -1023);
        EXPECT_EQ(values[4], -1016 + 120 * 12);
        EXPECT_EQ(values[15], -1016 + 120);
    }
    const EacValues fine = decodeEacSigned(blockFromBits(at(48, 3) | kEacIndices));
    EXPECT_EQ(fine[0], -13);
    EXPECT_EQ(fine[4], 12);
}

TEST(EacDecoder, valuesBecomeTheNearestOf16Bits)
{
    for (int value = 0; value <= 2047; ++value)
        EXPECT_EQ(eacUnorm(value), std::lround(value * 65535.0 / 2047));
    for (int value = -1023; value <= 1023; ++value)
        EXPECT_EQ(static_cast<int16_t>(eacSnorm(value)), std::lround(value * 32767.0 / 1023));
}

/// Draw a block of 16 bytes.
std::array<std::byte, 16> drawBytes(std::mt19937_64& random)
{
    return std::bit_cast<std::array<std::byte, 16>>(std::array{random(), random()});
}

TEST(Etc2Decoder, formatsAreMadeOfTheSameBlocks)
{
    std::mt19937_64 random(2);
    for (size_t trial = 0; trial < trials(2000); ++trial)
    {
        const std::array<std::byte, 16> bytes = drawBytes(random);
        const auto first = std::span(bytes).first<8>(), second = std::span(bytes).last<8>();
        const Texels rgb = decode(TexelFormat::etc2_rgb8_unorm, second);
        const Texels rgba = decode(TexelFormat::etc2_rgba8_unorm, bytes);
        const Texels red = decode(TexelFormat::eac_r11_unorm, first);
        const Texels green = decode(TexelFormat::eac_r11_unorm, second);
        const Texels both = decode(TexelFormat::eac_rg11_unorm, bytes);
        const Texels signed_red = decode(TexelFormat::eac_r11_snorm, first);
        const Texels signed_green = decode(TexelFormat::eac_r11_snorm, second);
        const Texels signed_both = decode(TexelFormat::eac_rg11_snorm, bytes);
        const EacValues alpha = decodeEacAlpha(first);
        for (size_t t = 0; t < 16; ++t)
        {
            ASSERT_EQ(rgb[t][3], 0xFFFF);
            const DecodedTexel with_alpha{rgb[t][0], rgb[t][1], rgb[t][2],
                                          static_cast<uint16_t>(alpha[t] * 257)};
            ASSERT_EQ(rgba[t], with_alpha);
            const DecodedTexel red_green{red[t][0], green[t][0], 0, 0xFFFF};
            ASSERT_EQ(both[t], red_green);
            const DecodedTexel signed_red_green{signed_red[t][0], signed_green[t][0], 0, 0x7FFF};
            ASSERT_EQ(signed_both[t], signed_red_green);
        }
        ASSERT_EQ(decode(TexelFormat::etc2_rgb8_srgb, second), rgb);
        ASSERT_EQ(decode(TexelFormat::etc2_rgba8_srgb, bytes), rgba);
        ASSERT_EQ(decode(TexelFormat::etc2_rgb8a1_srgb, second),
                  decode(TexelFormat::etc2_rgb8a1_unorm, second));
    }
}

} // namespace

} // namespace hearth::formats
