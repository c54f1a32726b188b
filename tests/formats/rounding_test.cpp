// Tests rounding from double to single precision: never to the wrong side, and never further than the next
// float.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/rounding.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace hearth::test
{

TEST(Rounding, givesTheNextFloatOnItsSide)
{
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> exponent(-50, 38);
    for (int i = 0; i < 100000; ++i)
    {
        const double value = (i % 2 == 0 ? 1 : -1) * std::pow(10.0, exponent(random));
        const float up = roundUp(value), down = roundDown(value);
        ASSERT_GE(double{up}, value);
        ASSERT_LT(double{std::nextafter(up, -kInfinity)}, value);
        ASSERT_LE(double{down}, value);
        ASSERT_GT(double{std::nextafter(down, kInfinity)}, value);
    }
}

TEST(Rounding, keepsFloatsAndStaysFinite)
{
    constexpr float kMaxFloat = std::numeric_limits<float>::max();
    for (const float value :
         {0.0f, 0.5f, -3.25f, kMaxFloat, -kMaxFloat, std::numeric_limits<float>::denorm_min()})
    {
        EXPECT_EQ(roundUp(double{value}), value);
        EXPECT_EQ(roundDown(double{value}), value);
    }
    EXPECT_EQ(roundUp(1e300), kMaxFloat);
    EXPECT_EQ(roundUp(-1e300), -kMaxFloat);
    EXPECT_EQ(roundDown(1e300), kMaxFloat);
    EXPECT_EQ(roundDown(-1e300), -kMaxFloat);
    EXPECT_EQ(roundUp(std::nan("")), kMaxFloat);
}

} // namespace hearth::test
