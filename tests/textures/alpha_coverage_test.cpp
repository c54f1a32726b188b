// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/alpha_coverage.h"

#include "cook/textures/mip_chain.h"
#include "tests/textures/texture_test_images.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hearth::textures
{

namespace
{

using namespace test;
using formats::ImageRecord;

/// Thin blades of grass, which lose most coverage by plain averaging.
std::vector<std::byte> grass(uint32_t size)
{
    std::vector<std::byte> texels = filled(size, size, {20, 120, 10, 0});
    for (uint32_t y = 0; y < size; ++y)
        for (uint32_t x = 0; x < size; ++x)
        {
            const double lean = std::sin(x * 0.61) * 0.1 * y;
            const double distance = std::fmod(x + lean + 1000, 7.3) - 2;
            const double alpha = std::clamp(1.2 - std::abs(distance), 0.0, 1.0);
            texels[(size_t{y} * size + x) * 4 + 3] = static_cast<std::byte>(alpha * 255);
        }
    return texels;
}

/// Leaves: discs of random size.
std::vector<std::byte> leaves(uint32_t size)
{
    std::mt19937 random(7);
    std::vector<std::byte> texels = filled(size, size, {20, 120, 10, 0});
    for (int leaf = 0; leaf < 60; ++leaf)
    {
        const double cx = static_cast<double>(random() % size);
        const double cy = static_cast<double>(random() % size);
        const double radius = static_cast<double>(2 + random() % 12);
        for (uint32_t y = 0; y < size; ++y)
            for (uint32_t x = 0; x < size; ++x)
                if (std::hypot(x - cx, y - cy) < radius)
                    texels[(size_t{y} * size + x) * 4 + 3] = std::byte{255};
    }
    return texels;
}

double computeCoverage(const ImageRecord& image, const std::vector<std::byte>& chain, uint32_t mip)
{
    const auto begin = static_cast<size_t>(formats::mipOffset(image, mip));
    const auto end = static_cast<size_t>(formats::mipOffset(image, mip + 1));
    return alphaCoverage(std::span(chain).subspan(begin, end - begin), 0.5f);
}

TEST(AlphaCoverage, countsWhatTheShaderKeeps)
{
    // 127 / 255 < 0.5 <= 128 / 255
    const std::vector<std::byte> below = filled(3, 1, {0, 0, 0, 127});
    const std::vector<std::byte> above = filled(3, 1, {0, 0, 0, 128});
    EXPECT_EQ(alphaCoverage(below, 0.5f), 0);
    EXPECT_EQ(alphaCoverage(above, 0.5f), 1);
    EXPECT_EQ(alphaCoverage(below, 0), 1);
    EXPECT_EQ(alphaCoverage(above, 1.5f), 0);
}

TEST(AlphaCoverage, mipsKeepItWithinTwoPercent)
{
    const ImageRecord image =
        makeRecord(256, 256, formats::TexelFormat::rgba8_srgb, formats::kImageAlphaTested);
    for (const std::vector<std::byte>& texels : {grass(256), leaves(256)})
    {
        const std::vector<std::byte> chain = buildMipChain(image, texels);
        const double finest = computeCoverage(image, chain, 0);
        for (uint32_t mip = 1; mip <= 5; ++mip) // below 8 x 8 one texel is more than 2 %
            EXPECT_NEAR(computeCoverage(image, chain, mip), finest, 0.02) << "mip " << mip;
    }
}

TEST(AlphaCoverage, plainMeansWouldLoseIt)
{
    const std::vector<std::byte> chain = buildMipChain(makeRecord(256, 256), grass(256));
    const ImageRecord image = makeRecord(256, 256);
    EXPECT_LT(computeCoverage(image, chain, 3), computeCoverage(image, chain, 0) - 0.1);
}

TEST(AlphaCoverage, nothingIsScaledWhereNothingOrAllPasses)
{
    FloatImage image{2, 1, {{0, 0, 0, 0.2f}, {0, 0, 0, 0.9f}}};
    EXPECT_EQ(scaleForCoverage(image, 0.5f, 0), 1);
    EXPECT_EQ(scaleForCoverage(image, 0, 1), 1);
    EXPECT_EQ(scaleForCoverage(image, 1.5f, 0.5), 1);
    EXPECT_EQ(scaleForCoverage(image, 0.5f, 0.5), 1);
}

TEST(AlphaCoverage, scaleLetsTheWantedSharePass)
{
    FloatImage image{100, 1, {}};
    for (int i = 0; i < 100; ++i)
        image.texels.push_back({0, 0, 0, 0.001f + static_cast<float>(i) * 0.003f});
    for (const double coverage : {0.01, 0.25, 0.5, 0.99, 1.0})
    {
        const float scale = scaleForCoverage(image, 0.5f, coverage);
        int passing = 0;
        for (const Float4& texel : image.texels)
            passing += std::floor(std::min(texel.w * scale, 1.0f) * 255 + 0.5f) >= 128 ? 1 : 0;
        EXPECT_NEAR(passing, coverage * 100, 1) << coverage;
    }
}

} // namespace

} // namespace hearth::textures
