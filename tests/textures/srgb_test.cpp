// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/srgb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hearth::textures
{

namespace
{

double encoded(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

TEST(SrgbTables, everyStoredValueComesBack)
{
    const SrgbTables& tables = SrgbTables::get();
    for (uint32_t value = 0; value < 256; ++value)
        ASSERT_EQ(tables.stored(tables.linear(static_cast<uint8_t>(value))), value);
}

TEST(SrgbTables, knownValues)
{
    const SrgbTables& tables = SrgbTables::get();
    EXPECT_EQ(tables.linear(0), 0.0f);
    EXPECT_EQ(tables.linear(255), 1.0f);
    EXPECT_NEAR(tables.linear(128), 0.2158605, 1e-6);
    EXPECT_EQ(tables.stored(0.5f), 188);
}

TEST(SrgbTables, storedIsTheNearestEncoding)
{
    const SrgbTables& tables = SrgbTables::get();
    for (uint32_t i = 0; i < 100000; ++i)
    {
        const float linear = static_cast<float>(i) / 99999.0f;
        const double exact = encoded(linear) * 255;
        // within a thousandth of the middle between two values either is right
        ASSERT_NEAR(tables.stored(linear), exact, 0.501) << linear;
    }
}

TEST(SrgbTables, valuesOutsideGoToTheEnds)
{
    const SrgbTables& tables = SrgbTables::get();
    EXPECT_EQ(tables.stored(-1), 0);
    EXPECT_EQ(tables.stored(7), 255);
    EXPECT_EQ(tables.stored(std::numeric_limits<float>::quiet_NaN()), 0);
}

} // namespace

} // namespace hearth::textures
