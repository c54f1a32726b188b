// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/etc2/etc2_encoder.h"

#include "formats/texels/etc2_decoder.h"
#include "formats/texels/etc2_tables.h"
#include "tests/support/sanitized.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <set>

namespace hearth::texels
{

namespace
{

using formats::DecodedTexel;
using formats::TexelFormat;
using test::trials;

constexpr std::array<Effort, 3> kEfforts{Effort::draft, Effort::normal, Effort::high};
constexpr ColorWeights kEqualWeights{1, 1, 1};

int extend(int code, int bits)
{
    return code << (8 - bits) | code >> (2 * bits - 8);
}

/// Return the sum of weighted squares that the decoder sees.
uint32_t recount(const Block8& block, std::span<const std::byte> bytes, const ColorWeights& weights)
{
    std::array<DecodedTexel, 16> texels;
    formats::decodeEtc2Block(formats::texelTraits(TexelFormat::etc2_rgb8_unorm), bytes, texels);
    uint32_t sum = 0;
    for (size_t t = 0; t < 16; ++t)
        for (size_t c = 0; c < 3; ++c)
        {
            const int difference = texels[t][c] / 257 - block[t][c];
            sum += weights[c] * static_cast<uint32_t>(difference * difference);
        }
    return sum;
}

class Blocks
{
public:
    explicit Blocks(uint64_t seed) : random_(seed) {}

    int draw(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }

    /// Draw a block of one of several kinds: noise of any range, slopes, two colours, colours at the ends of
    /// their range, halves.
    Block8 drawBlock()
    {
        Block8 block;
        const int kind = draw(0, 4), range = draw(0, 3) == 0 ? 255 : draw(0, 60);
        std::array<std::array<int, 4>, 4> colors; // of texels, or slopes
        for (auto& color : colors)
            for (int& channel : color)
                channel = kind == 3 ? 255 * draw(0, 1) : draw(0, 255);
        for (int t = 0; t < 16; ++t)
            for (size_t c = 0; c < 4; ++c)
            {
                int value = colors[0][c];
                if (kind == 1)
                    value += ((t % 4) * (colors[1][c] - 128) + (t / 4) * (colors[2][c] - 128)) / 8;
                else if (kind == 2 || kind == 3)
                    value = colors[static_cast<size_t>(t * 7 % 5 % 2)][c];
                else if (kind == 4)
                    value = colors[static_cast<size_t>(t / 8)][c];
                block[static_cast<size_t>(t)][c] = static_cast<uint8_t>(
                    std::clamp(value + (kind == 1 ? 0 : draw(-range, range) / 2), 0, 255));
            }
        return block;
    }

    std::array<uint8_t, 3> drawColor()
    {
        std::array<uint8_t, 3> color;
        for (uint8_t& channel : color)
            channel = static_cast<uint8_t>(draw(0, 255));
        return color;
    }

private:
    std::mt19937_64 random_;
};

Block8 constantBlock(const std::array<uint8_t, 3>& color)
{
    Block8 block;
    block.fill({color[0], color[1], color[2], 255});
    return block;
}

/// Return the least error of 16 equal texels in the modes differential, with equal halves, and planar.
uint32_t leastConstantError(const std::array<uint8_t, 3>& color, int max_modifier)
{
    const auto nearest = [](int value, int bits)
    {
        int least = INT32_MAX;
        for (int code = 0; code < 1 << bits; ++code)
            least = std::min(least, std::abs(extend(code, bits) - value));
        return least * least;
    };
    int least = nearest(color[0], 6) + nearest(color[1], 7) + nearest(color[2], 6);
    for (const auto& distances : formats::kEtcDistances)
        for (const int distance : distances)
            for (const int modifier : {-distance, distance})
                if (distance <= max_modifier)
                    least =
                        std::min(least, nearest(color[0] - modifier, 5) + nearest(color[1] - modifier, 5) +
                                            nearest(color[2] - modifier, 5));
    return 16 * static_cast<uint32_t>(least);
}

TEST(Etc2Encoder, equalTexelsAreAsExactAsTheFormatPermits)
{
    Blocks random(1);
    for (const Effort effort : kEfforts)
    {
        const Etc2Encoder encoder(effort);
        const int max_modifier = effort == Effort::draft ? 0 : effort == Effort::normal ? 60 : 183;
        for (size_t trial = 0; trial < trials(2000); ++trial)
        {
            const std::array<uint8_t, 3> color = random.drawColor();
            ASSERT_LE(encoder.encodeRgb(constantBlock(color)).error, leastConstantError(color, max_modifier))
                << static_cast<int>(effort) << ": " << int{color[0]} << ' ' << int{color[1]} << ' '
                << int{color[2]};
        }
    }
}

TEST(Etc2Encoder, slopesThatThePlanarModeHasAreExact)
{
    Blocks random(2);
    for (const Effort effort : {Effort::normal, Effort::high})
    {
        const Etc2Encoder encoder(effort);
        for (size_t trial = 0; trial < trials(1000); ++trial)
        {
            Block8 block;
            for (size_t c = 0; c < 3; ++c)
            {
                const int bits = c == 1 ? 7 : 6, max = (1 << bits) - 1;
                const int origin = extend(random.draw(max / 4, 3 * max / 4), bits);
                const int right = extend(random.draw(max / 4, 3 * max / 4), bits) - origin;
                const int below = extend(random.draw(max / 4, 3 * max / 4), bits) - origin;
                for (int t = 0; t < 16; ++t)
                    block[static_cast<size_t>(t)][c] = static_cast<uint8_t>(
                        std::clamp((t % 4 * right + t / 4 * below + 4 * origin + 2) >> 2, 0, 255));
            }
            ASSERT_EQ(encoder.encodeRgb(block).error, 0u);
        }
    }
}

TEST(Etc2Encoder, twoColoursOf4BitsAreExact)
{
    Blocks random(3);
    for (const Effort effort : kEfforts)
    {
        const Etc2Encoder encoder(effort);
        for (size_t trial = 0; trial < trials(500); ++trial)
        {
            std::array<std::array<uint8_t, 4>, 2> colors;
            for (auto& color : colors)
                for (uint8_t& channel : color)
                    channel = static_cast<uint8_t>(17 * random.draw(0, 15));
            Block8 block;
            for (auto& texel : block)
                texel = colors[static_cast<size_t>(random.draw(0, 1))];
            const EncodedColors encoded = encoder.encodeRgb(block);
            ASSERT_LE(encoded.error, effort == Effort::draft ? 1200u : 0u);
        }
    }
}

/// Name the mode of a block by the specification's sums.
std::string nameMode(const std::array<std::byte, 8>& bytes)
{
    if ((bytes[3] & std::byte{2}) == std::byte{0})
        return "individual";
    for (size_t c = 0; c < 3; ++c)
    {
        const auto byte = std::to_integer<uint8_t>(bytes[c]);
        const int step = byte & 7, sum = (byte >> 3) + (step < 4 ? step : step - 8);
        if (sum < 0 || sum > 31)
            return c == 0 ? "T" : c == 1 ? "H" : "planar";
    }
    return "differential";
}

TEST(Etc2Encoder, theErrorIsThatOfTheDecodedBlockInAllModes)
{
    Blocks random(4);
    std::set<std::string> modes;
    for (const Effort effort : kEfforts)
        for (const ColorWeights weights : {kEqualWeights, ColorWeights{3, 6, 1}})
        {
            const Etc2Encoder encoder(effort, weights);
            for (size_t trial = 0; trial < trials(400); ++trial)
            {
                const Block8 block = random.drawBlock();
                const EncodedColors encoded = encoder.encodeRgb(block);
                ASSERT_EQ(encoded.error, recount(block, encoded.bytes, weights));
                modes.insert(nameMode(encoded.bytes));
            }
        }
    EXPECT_EQ(modes.size(), 5u);
}

/// Return the error of the individual mode with upright halves, whose base colours are the rounded means.
uint32_t simpleError(const Block8& block)
{
    int sum = 0;
    for (int half = 0; half < 2; ++half)
    {
        std::array<int, 3> base{};
        for (int t = 0; t < 8; ++t)
            for (size_t c = 0; c < 3; ++c)
                base[c] += block[static_cast<size_t>(t / 2 * 4 + half * 2 + t % 2)][c];
        for (int& channel : base)
            channel = (channel + 68) / 136 * 17;
        int least = INT32_MAX;
        for (const auto& [lesser, greater] : formats::kEtcDistances)
        {
            int table_error = 0;
            for (int t = 0; t < 8; ++t)
            {
                int texel_error = INT32_MAX;
                for (const int modifier : {int{lesser}, int{greater}, -lesser, -greater})
                {
                    int error = 0;
                    for (size_t c = 0; c < 3; ++c)
                    {
                        const int difference = std::clamp(base[c] + modifier, 0, 255) -
                                               block[static_cast<size_t>(t / 2 * 4 + half * 2 + t % 2)][c];
                        error += difference * difference;
                    }
                    texel_error = std::min(texel_error, error);
                }
                table_error += texel_error;
            }
            least = std::min(least, table_error);
        }
        sum += least;
    }
    return static_cast<uint32_t>(sum);
}

TEST(Etc2Encoder, isNeverWorseThanRoundedMeans)
{
    Blocks random(5);
    for (const Effort effort : {Effort::normal, Effort::high})
    {
        const Etc2Encoder encoder(effort);
        for (size_t trial = 0; trial < trials(500); ++trial)
        {
            const Block8 block = random.drawBlock();
            ASSERT_LE(encoder.encodeRgb(block).error, simpleError(block));
        }
    }
}

TEST(Etc2Encoder, moreEffortHasLessErrorInTheMean)
{
    Blocks random(6);
    std::array<uint64_t, 3> errors{};
    const std::array<Etc2Encoder, 3> encoders{Etc2Encoder(Effort::draft), Etc2Encoder(Effort::normal),
                                              Etc2Encoder(Effort::high)};
    for (size_t trial = 0; trial < trials(400); ++trial)
    {
        const Block8 block = random.drawBlock();
        for (size_t e = 0; e < 3; ++e)
            errors[e] += encoders[e].encodeRgb(block).error;
    }
    EXPECT_LT(errors[1], errors[0]);
    EXPECT_LE(errors[2], errors[1]); // equal where few blocks are tried
}

TEST(Etc2Encoder, blocksDoNotDependOnEachOther)
{
    const Etc2Encoder encoder(Effort::normal);
    Blocks random(7);
    std::vector<Block8> blocks;
    std::vector<std::array<std::byte, 16>> encoded;
    for (size_t b = 0; b < trials(300); ++b)
    {
        blocks.push_back(random.drawBlock());
        encoded.push_back(encoder.encodeRgba(blocks.back()).bytes);
    }
    const Etc2Encoder other(Effort::normal);
    for (size_t b = blocks.size(); b-- > 0;)
        ASSERT_EQ(other.encodeRgba(blocks[b]).bytes, encoded[b]);
}

TEST(Etc2Encoder, rgbaIsAlphaThenColours)
{
    Blocks random(8);
    const Etc2Encoder encoder(Effort::normal);
    for (size_t trial = 0; trial < trials(300); ++trial)
    {
        const Block8 block = random.drawBlock();
        const EncodedRgba encoded = encoder.encodeRgba(block);
        std::array<DecodedTexel, 16> texels;
        formats::decodeEtc2Block(formats::texelTraits(TexelFormat::etc2_rgba8_unorm), encoded.bytes, texels);
        uint32_t alpha_error = 0;
        for (size_t t = 0; t < 16; ++t)
        {
            const int difference = texels[t][3] / 257 - block[t][3];
            alpha_error += static_cast<uint32_t>(difference * difference);
        }
        ASSERT_EQ(encoded.alpha_error, alpha_error);
        ASSERT_EQ(encoded.color_error, recount(block, std::span(encoded.bytes).last<8>(), kEqualWeights));
    }
    EXPECT_EQ(encoder.encodeRgba(constantBlock({1, 2, 3})).alpha_error, 0u);
}

} // namespace

} // namespace hearth::texels
