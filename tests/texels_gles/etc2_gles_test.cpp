// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/etc2_decoder.h"

#include "tests/support/sanitized.h"
#include "tests/texels_gles/gles_decoder.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace hearth::formats
{

namespace
{

using test::GlesDecoder;
using test::trials;

enum class Mode : uint8_t
{
    individual,
    differential,
    t,
    h,
    planar,
};

using ColorBlock = std::array<uint8_t, 8>;

/// Tell the mode, with or without the individual one.
Mode findMode(const ColorBlock& block, bool is_punched)
{
    if ((block[3] & 2) == 0 && !is_punched)
        return Mode::individual;
    for (size_t c = 0; c < 3; ++c)
    {
        const int sum = (block[c] >> 3) + (static_cast<int8_t>(block[c] << 5) >> 5);
        if (sum < 0 || sum > 31)
            return static_cast<Mode>(2 + c);
    }
    return Mode::differential;
}

/// Draw random blocks: of colours as many of each mode, of single channels some at the ends of all ranges.
std::vector<std::byte> drawBlocks(const TexelFormatTraits& traits, size_t count, std::mt19937_64& random)
{
    const bool is_punched =
        traits.format == TexelFormat::etc2_rgb8a1_unorm || traits.format == TexelFormat::etc2_rgb8a1_srgb;
    const bool is_single = traits.channels < 3;
    std::vector<std::byte> blocks;
    blocks.reserve(count * traits.block_bytes);
    const auto drawWord = [&] { return std::bit_cast<ColorBlock>(random()); };
    for (size_t b = 0; b < count; ++b)
        for (uint32_t half = 0; half < traits.block_bytes / 8u; ++half)
        {
            ColorBlock word = drawWord();
            if (is_single || (traits.block_bytes == 16 && half == 0))
            {
                constexpr std::array<uint8_t, 6> kBases{0, 1, 127, 128, 129, 255};
                if (random() % 4 == 0)
                    word[0] = kBases[random() % kBases.size()];
                if (random() % 4 == 0)
                    word[1] &= 15; // multiplier 0
            }
            else
            {
                const auto mode = static_cast<Mode>(is_punched ? 1 + random() % 4 : random() % 5);
                while (findMode(word, is_punched) != mode)
                    word = drawWord();
            }
            for (const uint8_t byte : word)
                blocks.push_back(std::byte{byte});
        }
    return blocks;
}

/// Return Mesa's code of a value that we decode. Mesa widens EAC's 11 bits to 16 by repeating the highest;
/// we round v / 2047 or v / 1023 to the nearest.
int mesaCode(const TexelFormatTraits& traits, uint16_t channel)
{
    if (traits.channels > 2)
        return channel;
    if (traits.coding == TexelCoding::unorm)
    {
        const auto eleven = static_cast<int>(std::lround(channel * 2047.0 / 65535));
        return eleven << 5 | eleven >> 6;
    }
    const int value = static_cast<int16_t>(channel);
    const auto eleven = static_cast<int>(std::lround(std::abs(value) * 1023.0 / 32767));
    const int widened = eleven << 5 | eleven >> 5;
    return value < 0 ? -widened : widened;
}

/// Return the code of 16 bits of a value that a shader reads, which must be near one.
int codeFromFloat(TexelCoding coding, float value)
{
    const double scaled = value * (coding == TexelCoding::snorm ? 32767.0 : 65535.0);
    EXPECT_NEAR(scaled, std::round(scaled), 0.02);
    return static_cast<int>(std::lround(scaled));
}

/// Compare a block of ours with Mesa's texels.
/// stride  texels of a row of theirs
void expectEqual(const TexelFormatTraits& traits, const std::array<DecodedTexel, 16>& ours,
                 const std::array<float, 4>* theirs, size_t stride)
{
    for (size_t t = 0; t < 16; ++t)
    {
        const std::array<float, 4>& their_texel = theirs[t / 4 * stride + t % 4];
        for (size_t c = 0; c < traits.channels; ++c)
            ASSERT_EQ(mesaCode(traits, ours[t][c]), codeFromFloat(traits.coding, their_texel[c]))
                << "texel " << t << ", channel " << c;
        for (size_t c = traits.channels; c < 4; ++c)
            ASSERT_EQ(their_texel[c], c == 3 ? 1.0f : 0.0f);
    }
}

TEST(Etc2Gles, everyFormatIsThatOfMesa)
{
    const GlesDecoder mesa;
    std::mt19937_64 random(1);
    constexpr uint32_t kWidth = 512;
    const auto height = static_cast<uint32_t>(4 * trials(96)); // 12288 blocks
    for (const TexelFormatTraits& traits : detail::kTexelFormats)
    {
        if (traits.family != TexelFamily::etc2)
            continue;
        SCOPED_TRACE(traits.name);
        const std::vector<std::byte> blocks = drawBlocks(traits, size_t{kWidth} * height / 16, random);
        const std::vector<std::array<float, 4>> theirs = mesa.decode(traits, kWidth, height, blocks);
        for (uint32_t b = 0; b < blocks.size() / traits.block_bytes; ++b)
        {
            std::array<DecodedTexel, 16> texels;
            const std::span<const std::byte> block =
                std::span(blocks).subspan(size_t{b} * traits.block_bytes, traits.block_bytes);
            decodeEtc2Block(traits, block, texels);
            const size_t x = b % (kWidth / 4) * 4, y = b / (kWidth / 4) * 4;
            SCOPED_TRACE(b);
            expectEqual(traits, texels, &theirs[y * kWidth + x], kWidth);
            if (testing::Test::HasFailure())
                return;
        }
    }
}

} // namespace

} // namespace hearth::formats
