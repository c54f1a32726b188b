// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/receivers/receivers.h"
#include "formats/texels/rgbm.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace
{

using namespace hearth;

using Color = std::array<double, 3>;

/// Decode a texel of E5B9G9R9 by the formula of Vulkan, in double.
Color decodeByFormula(uint32_t word)
{
    const double step = std::pow(2.0, static_cast<double>(word >> 27) - 15 - 9);
    return {(word % 512) * step, (word / 512 % 512) * step, (word / 262144 % 512) * step};
}

/// Decode bytes r, g, b, m by the formula of the talk, in double.
Color decodeRgbmByFormula(uint32_t word)
{
    const double m = (word >> 24) / 255.0;
    Color color;
    for (size_t c = 0; c < 3; ++c)
        color[c] = std::pow(6 * ((word >> (8 * c)) % 256 / 255.0) * m, 2);
    return color;
}

Color toColor(Float3 v)
{
    return {double{v.x}, double{v.y}, double{v.z}};
}

/// Return the largest difference of a channel as a share of the largest channel of `wanted`.
double worstError(const Color& wanted, const Color& got)
{
    double error = 0;
    for (size_t c = 0; c < 3; ++c)
        error = std::max(error, std::abs(got[c] - wanted[c]));
    return error / *std::max_element(wanted.begin(), wanted.end());
}

/// Random colour whose largest channel is spread evenly over the powers of two from `low` to `high`.
Color randomColor(std::mt19937& random, double low, double high)
{
    std::uniform_real_distribution<double> unit(0, 1);
    const double largest = low * std::pow(high / low, unit(random));
    Color color{largest, largest * unit(random), largest * unit(random) * unit(random)};
    std::rotate(color.begin(), color.begin() + random() % 3, color.end());
    return color;
}

/// Encode in double: the largest channel's exponent, and each mantissa to the nearest, halves up.
uint32_t encodeByFormula(const Color& color)
{
    const double largest = std::min(65408.0, *std::max_element(color.begin(), color.end()));
    for (int exponent = 0;; ++exponent)
    {
        const double step = std::ldexp(1.0, exponent - 15 - 9);
        if (std::round(largest / step) > 511)
            continue;
        uint32_t word = largest == 0 ? 0 : static_cast<uint32_t>(exponent) << 27;
        for (size_t c = 0; c < 3; ++c)
            word |= static_cast<uint32_t>(std::round(std::clamp(color[c], 0.0, 65408.0) / step)) << (9 * c);
        return word;
    }
}

TEST(ReceiverCodes, sharedExponentsAreThoseOfTheFormula)
{
    std::mt19937 random(1);
    double worst = 0;
    for (size_t i = 0; i < test::trials(200'000); ++i)
    {
        const Color color = randomColor(random, 1e-9, 1e6);
        const Float3 narrow{static_cast<float>(color[0]), static_cast<float>(color[1]),
                            static_cast<float>(color[2])};
        const uint32_t word = shared::encodeSharedExponentWord(narrow);
        ASSERT_EQ(word, encodeByFormula(toColor(narrow))) << color[0] << ' ' << color[1] << ' ' << color[2];
        const Color decoded = toColor(shared::decodeSharedExponentWord(word));
        ASSERT_EQ(decoded, decodeByFormula(word));
        const double largest = *std::max_element(color.begin(), color.end());
        if (largest >= 1e-3 && largest <= 65408)
            worst = std::max(worst, worstError(color, decoded));
    }
    EXPECT_LE(worst, 0.0020);
    EXPECT_GE(worst, test::kSanitized ? 0 : 0.0015); // that colours are hard to store
}

TEST(ReceiverCodes, sharedExponentsRoundHalvesUpAndLimitWhatTheyCannotHold)
{
    const auto encode = [](float x) { return shared::encodeSharedExponentWord({x, x, x}) & 0x1FF; };
    const float step = std::ldexp(1.0f, -24);
    EXPECT_EQ(encode(0.5f * step), 1u);
    EXPECT_EQ(encode(std::nextafter(0.5f, 0.0f) * step), 0u);
    EXPECT_EQ(shared::decodeSharedExponentWord(shared::encodeSharedExponentWord({1e9f, -1, NAN})),
              (Float3{65408, 0, 0}));
    EXPECT_EQ(shared::encodeSharedExponentWord({0, 0, 0}), 0u);
    // rounded up past nine bits: the next exponent
    EXPECT_EQ(shared::decodeSharedExponentWord(shared::encodeSharedExponentWord({0.99999f, 0, 0})).x, 1.0f);
}

TEST(ReceiverCodes, rgbmIsOffByHalfAPercentOfTheLargestChannelWithoutBias)
{
    std::mt19937 random(2);
    double worst = 0, ratio = 0;
    const size_t count = test::trials(200'000);
    for (size_t i = 0; i < count; ++i)
    {
        const Color color = randomColor(random, 0.01, 36);
        const uint32_t word = formats::encodeRgbm(color);
        const Color exact = decodeRgbmByFormula(word);
        const Color decoded = toColor(shared::decodeRgbmWord(word));
        for (size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(decoded[c], exact[c], 1e-6 * exact[c]);
        worst = std::max(worst, worstError(color, decoded));
        ratio += *std::max_element(decoded.begin(), decoded.end()) /
                 *std::max_element(color.begin(), color.end()) / static_cast<double>(count);
    }
    EXPECT_LE(worst, 0.0052);
    EXPECT_GE(worst, 0.003); // that colours are hard to store
    // A guard against division by 0 in the reference implementation dims all light by up to 1.6 %.
    EXPECT_NEAR(ratio, 1, test::kSanitized ? 2e-3 : 2e-4);
}

TEST(ReceiverCodes, rgbmHoldsBlackAndAnyDarkness)
{
    EXPECT_EQ(shared::decodeRgbmWord(formats::encodeRgbm({0, 0, 0})), (Float3{0, 0, 0}));
    for (double value = 1e-30; value < 1e-3; value *= 3)
    {
        const Color decoded = toColor(shared::decodeRgbmWord(formats::encodeRgbm({value, 0, value / 2})));
        EXPECT_TRUE(std::isfinite(decoded[0]));
        EXPECT_NEAR(std::sqrt(decoded[0]), std::sqrt(value), 1e-4) << value;
    }
    EXPECT_EQ(formats::encodeRgbm({0, 0, 0}) >> 24, 1u);
    // a factor of 0 is no code of the encoder, and is black
    EXPECT_EQ(shared::decodeRgbmWord(0x00FFFFFF), (Float3{0, 0, 0}));
}

TEST(ReceiverCodes, placesKeepAllBitsOfBothCoordinates)
{
    for (const uint32_t x : {0u, 1u, 4095u, 4096u, 8191u, 16383u})
        for (const uint32_t y : {0u, 1u, 4095u, 4096u, 8191u, 16383u})
        {
            const uint32_t place = shared::encodeReceiverPlace(x, y);
            EXPECT_LT(place, 1u << 28);
            EXPECT_EQ(shared::receiverX(place), x);
            EXPECT_EQ(shared::receiverY(place), y);
        }
}

} // namespace
