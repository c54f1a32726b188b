// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hearth
{

namespace
{

TEST(Half, everyFiniteHalfComesBack)
{
    for (uint32_t bits = 0; bits < 0x10000; ++bits)
    {
        const auto half = static_cast<uint16_t>(bits);
        if ((half & 0x7C00u) == 0x7C00u)
            continue;
        ASSERT_EQ(halfFromFloat(floatFromHalf(half)), half);
    }
}

TEST(Half, roundsToTheNearestAndTiesToEven)
{
    for (uint32_t bits = 0; bits < 0x7BFF; ++bits)
    {
        const auto low = static_cast<uint16_t>(bits);
        const auto high = static_cast<uint16_t>(bits + 1);
        const float middle =
            (floatFromHalf(low) + floatFromHalf(high)) / 2; // exact: one bit more than a half has
        ASSERT_EQ(halfFromFloat(middle), (low & 1u) == 0 ? low : high) << bits;
        ASSERT_EQ(halfFromFloat(std::nextafter(middle, 0.0f)), low) << bits;
        ASSERT_EQ(halfFromFloat(std::nextafter(middle, 1e9f)), high) << bits;
    }
}

TEST(Half, knownValues)
{
    EXPECT_EQ(halfFromFloat(1), 0x3C00);
    EXPECT_EQ(halfFromFloat(-2), 0xC000);
    EXPECT_EQ(halfFromFloat(0x1p-24f), 1);
    EXPECT_EQ(floatFromHalf(0x3555), 0.333251953125f);
}

TEST(Half, whatDoesNotFitBecomesTheLargest)
{
    EXPECT_EQ(halfFromFloat(1e10f), 0x7BFF);
    EXPECT_EQ(halfFromFloat(-std::numeric_limits<float>::infinity()), 0xFBFF);
    EXPECT_EQ(halfFromFloat(std::numeric_limits<float>::quiet_NaN()), 0);
}

} // namespace

} // namespace hearth
