// Expected errors of blocks beside variances counted texel by texel.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/search/error_estimate.h"
#include "tests/texels/test_images.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace hearth::texels
{

namespace
{

using namespace test;
using namespace formats;

/// Count the variance of a block times its texels, of red, green and blue as parts of their range.
double countSpread(const TestImage& image, uint32_t left, uint32_t top, uint32_t width, uint32_t height)
{
    double spread = 0;
    for (uint32_t c = 0; c < 3; ++c)
    {
        double sum = 0, squares = 0, texels = 0;
        for (uint32_t y = top; y < std::min(top + height, image.record.height); ++y)
            for (uint32_t x = left; x < std::min(left + width, image.record.width); ++x)
            {
                const size_t at = (size_t{y} * image.record.width + x) * 4 + c;
                const double value = std::to_integer<int>(image.mips[at]) / 255.0;
                sum += value;
                squares += value * value;
                texels += 1;
            }
        spread += squares - sum * sum / texels;
    }
    return spread;
}

void expectVariances(const TestImage& image, uint32_t block_width, uint32_t block_height)
{
    const uint32_t width = image.record.width, height = image.record.height;
    const std::vector<float> expected =
        MipDetail(image.plain(ImageRole::color, kRgb), 0).expectErrors(block_width, block_height, nullptr);
    std::vector<double> spreads, texels;
    for (uint32_t y = 0; y < height; y += block_height)
        for (uint32_t x = 0; x < width; x += block_width)
        {
            spreads.push_back(countSpread(image, x, y, block_width, block_height));
            texels.push_back(std::min(block_width, width - x) * std::min(block_height, height - y));
        }
    ASSERT_EQ(expected.size(), spreads.size());
    const double all = std::accumulate(spreads.begin(), spreads.end(), 0.0);
    for (size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(expected[i], 0.8 * spreads[i] / all + 0.2 * texels[i] / (width * height), 2e-6) << i;
}

TEST(ImageDetail, expectedErrorsGrowWithTheVarianceOfBlocks)
{
    expectVariances(makeImage(90, 66, 1, TexelFormat::rgba8_srgb, photographic(0.1)), 8, 4);
    // blocks that cut cells have parts of them, exact where cells are even
    const auto even = [](uint32_t c, double x, double y)
    { return 0.5 + 0.4 * std::sin(3 * std::floor(x * 22.5) + 5 * std::floor(y * 16.5) + c); };
    const TestImage cells = makeImage(90, 66, 1, TexelFormat::rgba8_srgb, even);
    expectVariances(cells, 6, 6);
    expectVariances(cells, 10, 5);
}

TEST(ImageDetail, smoothCellsAreExpectedToErrAsMuchAsAllOthers)
{
    // one square of noise on a wave that is smooth
    const auto value = [noise = photographic(1)](uint32_t c, double x, double y) mutable
    { return x < 0.25 && y < 0.25 ? noise(c, x, y) : 0.5 + 0.2 * std::sin(3 * x + c); };
    const TestImage image = makeImage(128, 128, 1, TexelFormat::rgba8_srgb, value);
    const PlainImage plain = image.plain(ImageRole::color, kRgb);
    const ImageDetail detail(plain);
    ASSERT_FALSE(detail.smooth.empty());
    const std::vector<float> alone = detail.mips[0].expectErrors(8, 8, nullptr);
    const std::vector<float> both = detail.mips[0].expectErrors(8, 8, &detail.smooth[0]);
    const auto sumSmooth = [](std::span<const float> expected)
    {
        double sum = 0;
        for (size_t i = 0; i < expected.size(); ++i)
            sum += i % 16 < 4 && i / 16 < 4 ? 0 : double{expected[i]};
        return sum;
    };
    EXPECT_LT(sumSmooth(alone), 0.3);
    EXPECT_GT(sumSmooth(both), 0.5);
}

TEST(ImageDetail, estimatesSeeErrorsInFewBlocks)
{
    // a 256th of the image has noise, the rest grain
    const auto value =
        [noise = photographic(1), grain = photographic(0.02)](uint32_t c, double x, double y) mutable
    { return x < 1.0 / 16 && y < 1.0 / 16 ? noise(c, x, y) : grain(c, 0.3, 0.3); };
    const TestImage image = makeImage(512, 512, 1, TexelFormat::rgba8_srgb, value);
    const PlainImage plain = image.plain(ImageRole::color, kRgb);
    const ImageDetail detail(plain);
    for (const Candidate& candidate : listCandidates(plain, {.astc = true}))
        if (candidate.traits->block_width == 8)
        {
            const double whole = measureError(plain, detail.smooth, candidate,
                                              encodeImage(plain, detail.smooth, candidate, Effort::draft))
                                     .error;
            ErrorEstimate estimate(plain, detail, candidate, Effort::draft);
            estimate.refine();
            EXPECT_NEAR(-20 * std::log10(estimate.error().error), -20 * std::log10(whole), 0.5)
                << candidate.traits->name;
        }
}

} // namespace

} // namespace hearth::texels
