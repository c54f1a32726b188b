// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/etc2/eac_encoder.h"

#include "formats/texels/eac_decoder.h"
#include "formats/texels/etc2_tables.h"
#include "tests/support/sanitized.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace hearth::texels
{

namespace
{

using test::trials;

constexpr std::array<Effort, 3> kEfforts{Effort::draft, Effort::normal, Effort::high};

using Alphas = std::array<uint8_t, 16>;
using Codes = std::array<uint16_t, 16>;

/// Draw values of a random range, at times near the ends.
template <typename Code>
std::array<Code, 16> drawCodes(std::mt19937_64& random)
{
    constexpr int kMax = std::numeric_limits<Code>::max();
    const auto draw = [&](int from, int to) { return std::uniform_int_distribution<int>(from, to)(random); };
    const int range = std::max(kMax >> draw(0, 7), 1), from = draw(-range / 2, kMax - range / 2);
    std::array<Code, 16> codes;
    for (Code& code : codes)
        code = static_cast<Code>(std::clamp(from + draw(0, range), 0, kMax));
    return codes;
}

uint32_t recount(const Alphas& alphas, const std::array<std::byte, 8>& bytes)
{
    const formats::EacValues values = formats::decodeEacAlpha(bytes);
    uint32_t sum = 0;
    for (size_t t = 0; t < 16; ++t)
        sum += static_cast<uint32_t>((values[t] - alphas[t]) * (values[t] - alphas[t]));
    return sum;
}

uint64_t recount(const Codes& codes, std::span<const std::byte, 8> bytes)
{
    const formats::EacValues values = formats::decodeEacUnsigned(bytes);
    uint64_t sum = 0;
    for (size_t t = 0; t < 16; ++t)
    {
        const int64_t difference = int64_t{formats::eacUnorm(values[t])} - codes[t];
        sum += static_cast<uint64_t>(difference * difference);
    }
    return sum;
}

TEST(EacEncoder, equalTexelsAreExact)
{
    for (const Effort effort : kEfforts)
    {
        for (int alpha = 0; alpha < 256; ++alpha)
        {
            Alphas alphas;
            alphas.fill(static_cast<uint8_t>(alpha));
            ASSERT_EQ(encodeEacAlpha(alphas, effort).error, 0u) << alpha;
        }
        for (int value = 0; value < 2048; ++value)
        {
            Codes codes;
            codes.fill(formats::eacUnorm(value));
            ASSERT_EQ(encodeEacR11(codes, effort).error, 0u) << value;
        }
    }
}

TEST(EacEncoder, theErrorIsThatOfTheDecodedBlock)
{
    std::mt19937_64 random(1);
    for (const Effort effort : kEfforts)
        for (size_t trial = 0; trial < trials(1000); ++trial)
        {
            const auto alphas = drawCodes<uint8_t>(random);
            const EncodedAlpha alpha = encodeEacAlpha(alphas, effort);
            ASSERT_EQ(alpha.error, recount(alphas, alpha.bytes));
            ASSERT_NE(alpha.bytes[1] & std::byte{0xF0}, std::byte{0}) << "no encoder may write multiplier 0";

            Block16 block{};
            const auto red = drawCodes<uint16_t>(random), green = drawCodes<uint16_t>(random);
            for (size_t t = 0; t < 16; ++t)
                block[t] = {red[t], green[t], 0, 0};
            const EncodedRg11 both = encodeEacRg11(block, effort);
            ASSERT_EQ(both.error, recount(red, std::span(both.bytes).first<8>()) +
                                      recount(green, std::span(both.bytes).last<8>()));
            ASSERT_EQ(encodeEacRg11(block, effort).bytes, both.bytes);
        }
}

/// Return the least error of all blocks.
uint32_t leastAlphaError(const Alphas& alphas)
{
    int least = INT32_MAX;
    for (const auto& modifiers : formats::kEacModifiers)
        for (int multiplier = 1; multiplier < 16; ++multiplier)
            for (int base = 0; base < 256; ++base)
            {
                std::array<int, 16> nearest;
                nearest.fill(INT32_MAX);
                for (const int modifier : modifiers)
                    for (size_t t = 0; t < 16; ++t)
                        nearest[t] =
                            std::min(nearest[t],
                                     std::abs(std::clamp(base + multiplier * modifier, 0, 255) - alphas[t]));
                int error = 0;
                for (const int distance : nearest)
                    error += distance * distance;
                least = std::min(least, error);
            }
    return static_cast<uint32_t>(least);
}

TEST(EacEncoder, isNearTheBestOfAllBlocks)
{
    std::mt19937_64 random(2);
    std::array<double, 3> errors{};
    double least = 0;
    for (size_t trial = 0; trial < trials(20); ++trial)
    {
        const auto alphas = drawCodes<uint8_t>(random);
        const uint32_t least_error = leastAlphaError(alphas);
        least += least_error;
        for (size_t e = 0; e < 3; ++e)
        {
            const uint32_t error = encodeEacAlpha(alphas, kEfforts[e]).error;
            ASSERT_GE(error, least_error);
            errors[e] += error;
        }
    }
    EXPECT_LE(errors[0], 1.25 * least);
    EXPECT_LE(errors[1], 1.05 * least);
    EXPECT_LE(errors[2], 1.02 * least);
}

} // namespace

} // namespace hearth::texels
