// Tests FLIP against values that follow from the paper's formulas, and against properties of human vision.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace hearth::reference
{
namespace
{

Image paint(uint32_t width, uint32_t height,
            const std::function<std::array<int, 3>(uint32_t, uint32_t)>& color)
{
    Image image(width, height);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
            for (size_t channel = 0; channel < 3; ++channel)
                image.at(x, y)[channel] = static_cast<uint8_t>(color(x, y)[channel]);
    return image;
}

Image plain(int r, int g, int b)
{
    return paint(48, 32, [=](uint32_t, uint32_t) { return std::array{r, g, b}; });
}

TEST(Flip, isZeroForEqualImages)
{
    const Image image = paint(48, 32,
                              [](uint32_t x, uint32_t y) {
                                  return std::array{int(x * 5), int(y * 7), int((x * y) % 256)};
                              });
    const FlipMap map = flip(image, image);
    EXPECT_EQ(*std::max_element(map.error.begin(), map.error.end()), 0.0f);
}

TEST(Flip, isOneBetweenPureGreenAndPureBlue)
{
    const FlipMap map = flip(plain(0, 255, 0), plain(0, 0, 255));
    for (const float error : map.error)
        ASSERT_NEAR(error, 1, 1e-6);
}

TEST(Flip, followsThePapersFormulaForBlackAndWhite)
{
    // Without features: HyAB = 100, raised to 0.7; for green and blue that is 41.276.
    const double difference = std::pow(100.0, 0.7), largest = 41.2760;
    const double expected = 0.95 + (difference - 0.4 * largest) / (0.6 * largest) * 0.05;
    EXPECT_NEAR(flip(plain(0, 0, 0), plain(255, 255, 255)).mean(), expected, 1e-4);
    // A difference below the knee: L* of sRGB 119 is 50.03, of 118 is 49.64.
    EXPECT_NEAR(flip(plain(119, 119, 119), plain(118, 118, 118)).mean(),
                std::pow(0.397, 0.7) * 0.95 / (0.4 * largest), 2e-4);
}

TEST(Flip, doesNotCareWhichImageIsTheReference)
{
    const Image a = paint(48, 32, [](uint32_t x, uint32_t) { return std::array{int(x * 5), 80, 30}; });
    const Image b = paint(48, 32, [](uint32_t, uint32_t y) { return std::array{90, int(y * 8), 200}; });
    EXPECT_EQ(flip(a, b).error, flip(b, a).error);
}

TEST(Flip, seesAMovedEdgeMoreThanASlowChange)
{
    const auto step = [](int edge)
    {
        return paint(64, 32,
                     [=](uint32_t x, uint32_t)
                     {
                         const int v = int(x) < edge ? 60 : 190;
                         return std::array{v, v, v};
                     });
    };
    const auto ramp = [](int shift)
    {
        return paint(64, 32,
                     [=](uint32_t x, uint32_t)
                     {
                         const int v = 60 + 2 * int(x) + shift;
                         return std::array{v, v, v};
                     });
    };
    const FlipMap moved = flip(step(32), step(34));
    const FlipMap slow = flip(ramp(0), ramp(4)); // the same sum of differences
    EXPECT_GT(*std::max_element(moved.error.begin(), moved.error.end()),
              4 * *std::max_element(slow.error.begin(), slow.error.end()));
    EXPECT_LT(moved.error[16 * 64 + 4], 1e-3f) << "far from the edge nothing changed";
}

TEST(Flip, forgivesAPatternTooFineToSee)
{
    // A checkerboard of single pixels, blue and yellow of equal luminance, against the grey of this luminance
    const Image checker = paint(64, 64,
                                [](uint32_t x, uint32_t y) {
                                    return (x + y) % 2 ? std::array{140, 140, 0} : std::array{118, 118, 255};
                                });
    const Image mean = paint(64, 64, [](uint32_t, uint32_t) { return std::array{130, 130, 188}; });
    const double from_afar = flip(mean, checker, 134).mean(), near = flip(mean, checker, 8).mean();
    EXPECT_LT(from_afar, 0.5 * near);
}

TEST(Flip, growsWithTheAmplitudeOfNoise)
{
    const auto noisy = [](int amplitude)
    {
        return paint(48, 48,
                     [=](uint32_t x, uint32_t y)
                     {
                         const uint32_t hash = (x * 73856093u ^ y * 19349663u) * 2654435761u >> 16;
                         const int v = 128 + (hash & 1u ? amplitude : -amplitude);
                         return std::array{v, v, v};
                     });
    };
    double last = 0;
    for (const int amplitude : {1, 4, 16, 64})
    {
        const double error = flip(noisy(0), noisy(amplitude)).mean();
        EXPECT_GT(error, last);
        last = error;
    }
    EXPECT_GT(last, 0.2);
}

TEST(PngImage, comesBackAsItWasWritten)
{
    const Image image = paint(31, 17,
                              [](uint32_t x, uint32_t y) {
                                  return std::array{int(x * 8), int(y * 15), int((x + y) * 5)};
                              });
    const std::string path = testing::TempDir() + "reference_image.png";
    ASSERT_TRUE(writePng(path, image).ok());
    const Result<Image> back = readPng(path);
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back->rgb, image.rgb);
    EXPECT_EQ(back->width, 31u);
    std::remove(path.c_str());
    EXPECT_EQ(readPng(path).error().issue, Issue::input_missing);
}

} // namespace
} // namespace hearth::reference
