// Targets of error are stricter where errors are seen. Smooth areas keep off edges.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/encoding/smooth_cells.h"
#include "cook/texels/search/target.h"
#include "tests/texels/test_images.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace hearth::texels
{

namespace
{

using namespace test;
using namespace formats;

constexpr double kDegree = std::numbers::pi / 180;

double toDecibels(double error)
{
    return -20 * std::log10(error);
}

/// Normal map whose texels lean to the left and to the right in turn, by an angle.
TestImage makeLeaningNormals(double degrees)
{
    const double lean = std::sin(degrees * kDegree);
    return makeImage(40, 24, 1, TexelFormat::rgba8_unorm,
                     [&](uint32_t c, double x, double)
                     {
                         const bool left = static_cast<int>(x * 40) % 2 == 0;
                         return c == 0 ? 0.5 + (left ? -0.5 : 0.5) * lean : 0.5;
                     });
}

} // namespace

TEST(TexelTarget, cutoutsAndSmallColorsAreHeldToMore)
{
    const auto gain = [](uint32_t width, uint32_t height, ImageRole role, TexelFormat format)
    {
        PlainImage image;
        image.record.width = width;
        image.record.height = height;
        image.record.format = static_cast<uint32_t>(format);
        image.role = role;
        const Target usual = findTarget(role, Effort::normal), found = findTarget(image, Effort::normal);
        EXPECT_EQ(found.smooth, usual.smooth);
        return toDecibels(found.error) - toDecibels(usual.error);
    };
    EXPECT_NEAR(gain(256, 256, ImageRole::color, TexelFormat::rgba8_srgb), 3, 0.01);
    EXPECT_NEAR(gain(512, 300, ImageRole::cutout, TexelFormat::rgba8_srgb), 6, 0.01);
    EXPECT_NEAR(gain(64, 64, ImageRole::cutout, TexelFormat::rgba8_srgb), 6, 0.01);
    EXPECT_EQ(gain(16, 257, ImageRole::color, TexelFormat::rgba8_srgb), 0);
    EXPECT_EQ(gain(64, 64, ImageRole::data, TexelFormat::rgba8_unorm), 0);
}

TEST(TexelTarget, normalsSpreadByTheAngleThatTheyLean)
{
    for (const double degrees : {0.0, 5.0, 12.0, 20.0})
        EXPECT_NEAR(findNormalSpread(makeLeaningNormals(degrees).plain(ImageRole::normal, kRed | kGreen)) /
                        kDegree,
                    degrees, 0.4)
            << "a code of 8 bits is .45 degrees";
}

TEST(TexelTarget, normalsMayLoseAPartOfTheirSpreadWithinBounds)
{
    const auto allowed = [](double degrees, Effort quality)
    {
        const TestImage image = makeLeaningNormals(degrees);
        return findTarget(image.plain(ImageRole::normal, kRed | kGreen), quality).error / kDegree;
    };
    EXPECT_NEAR(allowed(9, Effort::normal), 9.0 / 8, 0.05);
    EXPECT_NEAR(allowed(9, Effort::draft), 9.0 / 4, 0.1);
    EXPECT_NEAR(allowed(9, Effort::high), 9.0 / 16, 0.025);
    for (const Effort quality : {Effort::draft, Effort::normal, Effort::high})
    {
        const double usual = findTarget(ImageRole::normal, quality).error / kDegree;
        EXPECT_DOUBLE_EQ(allowed(1, quality), usual / 2);
        EXPECT_DOUBLE_EQ(allowed(30, quality), usual);
    }
}

TEST(TexelTarget, cellsBesideAnEdgeAreNotSmooth)
{
    // 16 x 8 cells; the edge lies inside column 5
    const TestImage image = makeImage(64, 32, 1, TexelFormat::rgba8_srgb,
                                      [](uint32_t c, double x, double) {
                                          return c == 3 ? 1 : x < 22.0 / 64 ? 0.2 : 0.6;
                                      });
    const SmoothCells cells(image.plain(ImageRole::color, kRgb), 0);
    for (uint32_t y = 0; y < 32; ++y)
        for (uint32_t x = 0; x < 64; ++x)
            EXPECT_EQ(cells.contains(x, y), x / 4 < 4 || x / 4 > 6) << x << ", " << y;
    EXPECT_EQ(cells.countSmooth(), 13u * 8);
}

TEST(TexelTarget, aSpotHidesNothingAroundIt)
{
    const TestImage image =
        makeImage(32, 32, 1, TexelFormat::rgba8_srgb,
                  [](uint32_t c, double x, double y)
                  {
                      const bool spot = static_cast<int>(x * 32) == 13 && static_cast<int>(y * 32) == 18;
                      return c == 3 || spot ? 1 : 0.5;
                  });
    EXPECT_EQ(SmoothCells(image.plain(ImageRole::color, kRgb), 0).countSmooth(), 64u - 1);
}

} // namespace hearth::texels
