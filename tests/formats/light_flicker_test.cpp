// Tests the flicker of lights: bits that all machines agree on, range, mean, smoothness, and long times.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/light_flicker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hearth::test
{

namespace
{

using namespace formats;

LightRecord candle(float rate, float amplitude, uint32_t seed)
{
    LightRecord light{};
    light.flicker_rate = rate;
    light.flicker_amplitude = amplitude;
    light.flicker_seed = seed;
    return light;
}

} // namespace

TEST(LightFlicker, hasTheSameBitsEverywhere)
{
    // value noise at an integer is its hash: computed with arbitrary integers in Python
    EXPECT_EQ(flickerNoise(0, 0), 0.0);
    EXPECT_EQ(flickerNoise(0, 1), 0x1.c4415072f63b9p-1);
    EXPECT_EQ(flickerNoise(7, -3), 0x1.d38b1e6dbc6adp-1);
    EXPECT_EQ(flickerNoise(7, 0.25), 0x1.acea5fe817d57p-1);
    EXPECT_EQ(flickerNoise(4294967295u, 1e9 + 0.5), 0x1.955c1515362d2p-1);
}

TEST(LightFlicker, dependsOnTimeAndSeedAlone)
{
    const LightRecord light = candle(7, 0.8f, 3);
    const double first = flickerFactor(light, 1.3);
    (void)flickerFactor(light, 900);
    (void)flickerFactor(candle(7, 0.8f, 4), 1.3);
    EXPECT_EQ(flickerFactor(light, 1.3), first);
    EXPECT_NE(flickerFactor(candle(7, 0.8f, 4), 1.3), first);
    EXPECT_NE(flickerFactor(light, 1.4), first);
    EXPECT_EQ(flickerFactor(LightRecord{}, 1.3), 1) << "a steady light";
}

TEST(LightFlicker, staysBetweenItsAmplitudeAndOneAndIsHalfWayOnAverage)
{
    constexpr int kSamples = 200'000;
    for (const uint32_t seed : {0u, 1u, 2u, 1000u, 4294967295u})
    {
        const LightRecord light = candle(5, 0.6f, seed);
        double sum = 0, low = 1, high = 0;
        for (int i = 0; i < kSamples; ++i)
        {
            const double factor = flickerFactor(light, i * 0.0131);
            sum += factor, low = std::min(low, factor), high = std::max(high, factor);
        }
        EXPECT_GE(low, 1 - double{0.6f});
        EXPECT_LE(high, 1);
        EXPECT_LT(low, 0.41) << "the whole amplitude is used";
        EXPECT_GT(high, 0.99);
        EXPECT_NEAR(sum / kSamples, 0.7, 0.005) << "seed " << seed;
    }
}

TEST(LightFlicker, hasNoJumps)
{
    // the curve's largest slope is 15/8 of the difference of two hashes
    constexpr double kStep = 1e-4, kMaxSlope = 15.0 / 8;
    double before = flickerNoise(9, -3);
    for (int i = 1; i < 60'000; ++i)
    {
        const double now = flickerNoise(9, -3 + i * kStep);
        ASSERT_LE(std::abs(now - before), kMaxSlope * kStep * (1 + 1e-6)) << i;
        before = now;
    }
}

TEST(LightFlicker, isExactAfterDays)
{
    // rate and times are sums of few powers of two, so the position is exact, in whole periods and a fraction
    constexpr double kRate = 8.5;
    const LightRecord light = candle(kRate, 1, 12);
    for (const double offset : {1e6, 1e7})
        for (int i = 0; i < 1000; ++i)
        {
            const double seconds = offset + i * 0.0625;
            const auto scaled = static_cast<int64_t>(offset) * 272 + int64_t{i} * 17; // position * 32
            const double cell = static_cast<double>(scaled >> 5), f = static_cast<double>(scaled & 31) / 32;
            const double from = flickerNoise(12, cell), to = flickerNoise(12, cell + 1);
            const double curve = f * f * f * (f * (f * 6 - 15) + 10);
            ASSERT_NEAR(1 - flickerFactor(light, seconds), from + curve * (to - from), 1e-15) << seconds;
        }
}

TEST(LightFlicker, takesAnyFiniteTime)
{
    for (const double seconds : {-1e300, -1e18, -0.0, 1e18, 1e300})
    {
        const double factor = flickerFactor(candle(1e30f, 1, 1), seconds);
        EXPECT_TRUE(factor >= 0 && factor <= 1) << seconds;
    }
}

} // namespace hearth::test
