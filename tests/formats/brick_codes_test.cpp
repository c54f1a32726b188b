// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/brick_codes.h"

#include "formats/codecs/vertex_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace hearth::test
{

using namespace shared;

namespace
{

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Value of code 0 to 31 * 2^mantissa_bits - 1, in double and by the definition.
double getValue(uint32_t code, uint32_t mantissa_bits)
{
    const auto scale = static_cast<double>(1u << mantissa_bits);
    const auto mantissa = static_cast<double>(code & ((1u << mantissa_bits) - 1));
    const auto exponent = static_cast<int>(code >> mantissa_bits);
    return exponent == 0 ? std::ldexp(mantissa / scale, -14)
                         : std::ldexp(1 + mantissa / scale, exponent - 15);
}

/// Code nearest to a value >= 0, by exhaustive search; the even code in a tie.
uint32_t nearestCode(double value, uint32_t mantissa_bits)
{
    const uint32_t count = 31u << mantissa_bits;
    uint32_t best = 0;
    for (uint32_t code = 1; code < count; ++code)
    {
        const double off = std::abs(getValue(code, mantissa_bits) - value);
        const double best_off = std::abs(getValue(best, mantissa_bits) - value);
        if (off < best_off || (off == best_off && code % 2 == 0))
            best = code;
    }
    return best;
}

/// Truncate the mantissa, as some hardware does.
uint32_t cutCode(float value, uint32_t mantissa_bits)
{
    const uint32_t nearest = encodeUnsignedFloat(value, mantissa_bits);
    return nearest > 0 && decodeUnsignedFloat(nearest, mantissa_bits) > value ? nearest - 1 : nearest;
}

} // namespace

TEST(UnsignedFloats, decodeAsTheyAreDefined)
{
    for (const uint32_t bits : {5u, 6u})
        for (uint32_t code = 0; code < 31u << bits; ++code)
            ASSERT_EQ(double{decodeUnsignedFloat(code, bits)}, getValue(code, bits)) << code;
    EXPECT_EQ(decodeUnsignedFloat((31u << 6) - 1, 6), kMaxRadianceRedGreen);
    EXPECT_EQ(decodeUnsignedFloat((31u << 5) - 1, 5), kMaxRadianceBlue);
}

TEST(UnsignedFloats, encodeWhatTheyDecode)
{
    for (const uint32_t bits : {5u, 6u})
        for (uint32_t code = 0; code < 31u << bits; ++code)
            ASSERT_EQ(encodeUnsignedFloat(decodeUnsignedFloat(code, bits), bits), code);
}

TEST(UnsignedFloats, roundToTheNearestBetweenAllNeighbours)
{
    for (const uint32_t bits : {5u, 6u})
        for (uint32_t code = 0; code + 1 < 31u << bits; ++code)
        {
            // exact in floats: one more bit than the codes have
            const auto middle = static_cast<float>((getValue(code, bits) + getValue(code + 1, bits)) / 2);
            ASSERT_EQ(encodeUnsignedFloat(middle, bits), code % 2 == 0 ? code : code + 1);
            ASSERT_EQ(encodeUnsignedFloat(std::nextafter(middle, 0.0f), bits), code);
            ASSERT_EQ(encodeUnsignedFloat(std::nextafter(middle, kInfinity), bits), code + 1);
        }
}

TEST(UnsignedFloats, roundAsASlowSearchDoes)
{
    std::mt19937 random(1);
    for (int i = 0; i < 1000; ++i)
    {
        // all magnitudes, and some out of range
        const auto value =
            static_cast<float>(std::exp2(std::uniform_real_distribution<double>(-25, 17)(random)));
        for (const uint32_t bits : {5u, 6u})
            ASSERT_EQ(encodeUnsignedFloat(value, bits), nearestCode(double{value}, bits)) << value;
    }
}

TEST(UnsignedFloats, areNeverInfiniteOrNoNumber)
{
    for (const uint32_t bits : {5u, 6u})
    {
        const uint32_t most = (31u << bits) - 1;
        for (const float large :
             {65025.0f, 65535.9f, 65536.0f, 1e20f, std::numeric_limits<float>::max(), kInfinity})
            EXPECT_EQ(encodeUnsignedFloat(large, bits), most) << large;
        for (const float none : {0.0f, -0.0f, -1.0f, -kInfinity, std::numeric_limits<float>::quiet_NaN(),
                                 std::numeric_limits<float>::denorm_min(), 1e-30f})
            EXPECT_EQ(encodeUnsignedFloat(none, bits), 0u) << none;
    }
}

TEST(Radiance, hasItsColoursWhereTheFormatSays)
{
    // VK_FORMAT_B10G11R11_UFLOAT_PACK32: 1 is 0x3C0 in 11 bits, 0x1E0 in 10
    EXPECT_EQ(encodeRadiance({1, 0, 0}), 0x3C0u);
    EXPECT_EQ(encodeRadiance({0, 1, 0}), 0x3C0u << 11);
    EXPECT_EQ(encodeRadiance({0, 0, 1}), 0x1E0u << 22);
    EXPECT_EQ(decodeRadiance(encodeRadiance({0.5f, 3, 20480})), (Float3{0.5f, 3, 20480}));
    EXPECT_TRUE(isLegalRadiance(encodeRadiance({kInfinity, kInfinity, kInfinity})));
    EXPECT_FALSE(isLegalRadiance(31u << 6));
    EXPECT_FALSE(isLegalRadiance(31u << 17));
    EXPECT_FALSE(isLegalRadiance(31u << 27));
}

/// Store grey light after each bounce off a grey surface, and measure how far rounding alone shifts blue
/// against red.
TEST(Radiance, keepsItsHueThrough64Bounces)
{
    std::mt19937 random(2);
    std::uniform_real_distribution<float> albedos(0.1f, 0.9f), emissions(1, 2);
    constexpr int kTries = 4000;
    double drift = 0, cut_drift = 0;
    for (int i = 0; i < kTries; ++i)
    {
        const float albedo = albedos(random), emission = emissions(random);
        float red = 0, blue = 0, cut_red = 0, cut_blue = 0;
        double exact = 0;
        for (int bounce = 0; bounce < 64; ++bounce)
        {
            exact = double{emission} + double{albedo} * exact;
            red = decodeUnsignedFloat(encodeUnsignedFloat(emission + albedo * red, 6), 6);
            blue = decodeUnsignedFloat(encodeUnsignedFloat(emission + albedo * blue, 5), 5);
            cut_red = decodeUnsignedFloat(cutCode(emission + albedo * cut_red, 6), 6);
            cut_blue = decodeUnsignedFloat(cutCode(emission + albedo * cut_blue, 5), 5);
        }
        // Each rounding is off by up to half a step of the mantissa, and earlier errors decay by the albedo.
        // The step may be that of the power of two above.
        const double gain = 1 / (1 - double{albedo});
        ASSERT_LE(std::abs(double{red} / exact - 1), gain * (1 + gain / 64) / 128)
            << albedo << " " << emission;
        ASSERT_LE(std::abs(double{blue} / exact - 1), gain * (1 + gain / 32) / 64)
            << albedo << " " << emission;
        drift += std::log(double{blue} / double{red}) / kTries;
        cut_drift += std::log(double{cut_blue} / double{cut_red}) / kTries;
    }
    // Light that grows from 0 stops half a step early, in blue twice as far. Truncation takes more at each
    // bounce.
    EXPECT_LT(std::abs(drift), 0.012);
    EXPECT_LT(cut_drift, 2 * drift) << drift;
}

TEST(Albedo, isThreeUnormsOfTenBits)
{
    for (uint32_t code = 0; code < 1024; ++code)
    {
        const float value = static_cast<float>(code) / 1023;
        ASSERT_EQ(encodeAlbedo({value, 0, 0}), code);
        ASSERT_EQ(encodeAlbedo({0, value, 0}), code << 10);
        ASSERT_EQ(encodeAlbedo({0, 0, value}), code << 20);
        ASSERT_EQ(decodeAlbedo(code | code << 10 | code << 20), (Float3{value, value, value}));
    }
    for (const uint32_t quarters : {0u, 1u, 2u, 3u})
    {
        const uint32_t code =
            encodeAlbedo({0.25f, 0.5f, 1}) | encodeFaceDepth(0.25f * static_cast<float>(quarters));
        EXPECT_EQ(decodeFaceDepth(code), 0.25f * static_cast<float>(quarters));
        EXPECT_EQ(encodeAlbedo(decodeAlbedo(code)), encodeAlbedo({0.25f, 0.5f, 1}));
    }
    EXPECT_EQ(encodeFaceDepth(-1), 0u);
    EXPECT_EQ(encodeFaceDepth(2), 3u << 30);
    EXPECT_EQ(encodeAlbedo({-1, 2, std::numeric_limits<float>::quiet_NaN()}), 1023u << 10);
    // ties round up
    EXPECT_EQ(encodeAlbedo({0.4999f / 1023, 1.5001f / 1023, 0}), 2u << 10);
}

TEST(FaceNormals, areThoseOfTheVertices)
{
    for (uint32_t code = 0; code < 65536; ++code)
    {
        if (!formats::NormalCode<8>::legal(code))
            continue;
        ASSERT_EQ(decodeFaceNormal(code), formats::NormalCode<8>::decode(code)) << code;
    }
}

} // namespace hearth::test
