// Roughness of mips: the mean of the lobes around the lost normals is near to the lobe of the new roughness.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/mip_chain.h"
#include "formats/base/math.h"
#include "tests/textures/texture_test_images.h"

#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <numbers>

namespace hearth::textures
{

namespace
{

using namespace test;
using formats::ImageRecord;
using formats::TexelFormat;

using Normal = std::array<double, 3>;

constexpr uint32_t kSide = 8;

/// Return 64 unit normals whose slopes have a normal distribution with a standard deviation, around a slope.
std::vector<Normal> spreadNormals(double sigma, double slope)
{
    // quantiles of the normal distribution at 1/16, 3/16, ..., scaled to a variance of 1
    const std::array<double, kSide> quantiles{-1.534, -0.887, -0.489, -0.157, 0.157, 0.489, 0.887, 1.534};
    double variance = 0;
    for (const double q : quantiles)
        variance += q * q / kSide;
    std::vector<Normal> normals;
    for (const double u : quantiles)
        for (const double v : quantiles)
        {
            const double x = slope + sigma * u / std::sqrt(variance), y = sigma * v / std::sqrt(variance);
            const double length = std::sqrt(x * x + y * y + 1);
            normals.push_back({x / length, y / length, 1 / length});
        }
    return normals;
}

std::vector<std::byte> encodeWide(std::span<const std::array<double, 4>> texels)
{
    std::vector<std::byte> bytes(texels.size() * 8);
    for (size_t i = 0; i < texels.size() * 4; ++i)
    {
        const auto channel = static_cast<uint16_t>(std::lround(texels[i / 4][i % 4] * 65535));
        std::memcpy(bytes.data() + i * 2, &channel, 2);
    }
    return bytes;
}

std::vector<std::byte> encodeNormals(std::span<const Normal> normals)
{
    std::vector<std::array<double, 4>> texels;
    for (const Normal& n : normals)
        texels.push_back({n[0] / 2 + 0.5, n[1] / 2 + 0.5, n[2] / 2 + 0.5, 1});
    return encodeWide(texels);
}

ImageRecord normalRecord(uint32_t width, uint32_t height, TexelFormat format)
{
    return makeRecord(width, height, format, formats::kImageNormalMap);
}

/// Return the roughness of the last mip of a constant roughness under normals.
double filteredRoughness(double roughness, std::span<const Normal> normals, double factor = 1,
                         double scale = 1)
{
    ImageRecord image = makeRecord(kSide, kSide, TexelFormat::rgba16_unorm);
    image.mip_count = fullMipCount(kSide, kSide);
    const std::vector<std::byte> normal_texels = encodeNormals(normals);
    RoughnessFilter filter({normalRecord(kSide, kSide, TexelFormat::rgba16_unorm), normal_texels,
                            static_cast<float>(scale), static_cast<float>(factor)});
    const std::vector<std::array<double, 4>> texels(size_t{kSide} * kSide, {0.25, roughness, 0.75, 1});
    const std::vector<std::byte> chain = buildMipChain(image, encodeWide(texels), 16, &filter);
    std::array<uint16_t, 4> last;
    std::memcpy(last.data(), chain.data() + chain.size() - 8, 8);
    EXPECT_NEAR(last[0], 0.25 * 65535, 1);
    EXPECT_NEAR(last[2], 0.75 * 65535, 1);
    return last[1] / 65535.0;
}

/// GGX: share of microfacets per solid angle, by the cosine to their axis.
double distribution(double cosine, double alpha)
{
    const double d = cosine * cosine * (alpha * alpha - 1) + 1;
    return cosine <= 0 ? 0 : alpha * alpha / (std::numbers::pi * d * d);
}

/// Return the area between the mean lobe of normals and one lobe around z, each of which has an area of 1.
double lobeDistance(std::span<const Normal> normals, double alpha, double single_alpha)
{
    constexpr int kRings = 200, kSectors = 48;
    double distance = 0;
    for (int ring = 0; ring < kRings; ++ring)
    {
        const double t = (ring + 0.5) / kRings; // rings are denser near the axis, where lobes are
        const double angle = t * t * std::numbers::pi / 2, step = t * std::numbers::pi / kRings;
        const double z = std::cos(angle), radius = std::sin(angle);
        for (int sector = 0; sector < kSectors; ++sector)
        {
            const double turn = 2 * std::numbers::pi * (sector + 0.5) / kSectors;
            const double x = radius * std::cos(turn), y = radius * std::sin(turn);
            double mean = 0;
            for (const Normal& n : normals)
                mean += distribution(n[0] * x + n[1] * y + n[2] * z, alpha) *
                        std::max(n[0] * x + n[1] * y + n[2] * z, 0.0) / static_cast<double>(normals.size());
            distance += std::abs(mean - distribution(z, single_alpha) * z) * radius * step * 2 *
                        std::numbers::pi / kSectors;
        }
    }
    return distance;
}

TEST(RoughnessFilter, oneLobeIsNearTheMeanOfSixtyFour)
{
    struct Row
    {
        double spread;        ///< of slopes, as a part of alpha
        double before, after; ///< of a continuous spread, 64 normals are a little off
    };
    for (const double roughness : {0.25, 0.4})
        for (const Row& row : {Row{0.25, 0.068, 0.041}, Row{0.5, 0.224, 0.113}, Row{1, 0.558, 0.216}})
        {
            const double alpha = roughness * roughness;
            const std::vector<Normal> normals = spreadNormals(row.spread * alpha, 0);
            const double filtered = filteredRoughness(roughness, normals);
            EXPECT_NEAR(lobeDistance(normals, alpha, alpha), row.before, 0.08 * row.before)
                << roughness << ' ' << row.spread;
            EXPECT_LT(lobeDistance(normals, alpha, filtered * filtered), 1.25 * row.after)
                << roughness << ' ' << row.spread;
        }
}

TEST(RoughnessFilter, aTiltOfTheSurfaceChangesNothing)
{
    // the same cap of normals, turned by 40 degrees
    std::vector<Normal> turned = spreadNormals(0.2, 0);
    const double upright = filteredRoughness(0.3, turned);
    const double c = std::cos(0.7), s = std::sin(0.7);
    for (Normal& n : turned)
        n = {c * n[0] + s * n[2], n[1], c * n[2] - s * n[0]};
    EXPECT_NEAR(filteredRoughness(0.3, turned), upright, 1e-4);
    EXPECT_GT(upright, 0.5);
}

TEST(RoughnessFilter, factorsOfTheMaterialCount)
{
    const std::vector<Normal> normals = spreadNormals(0.1, 0);
    // a factor of one half on twice the texel is the same surface
    EXPECT_NEAR(filteredRoughness(0.8, normals, 0.5) * 0.5, filteredRoughness(0.4, normals), 1e-4);
    EXPECT_EQ(filteredRoughness(0.9, spreadNormals(1, 0), 0.1), 1)
        << "the factor is the most that a shader shows";
    // slopes of twice the scale
    EXPECT_NEAR(filteredRoughness(0.4, normals, 1, 2), filteredRoughness(0.4, spreadNormals(0.2, 0)), 1e-3);
}

TEST(RoughnessFilter, alikeNormalsLeaveBytesAsTheyAre)
{
    for (const Rgba8 normal : {Rgba8{128, 128, 255, 255}, Rgba8{200, 90, 220, 255}, Rgba8{128, 128, 128, 0}})
        for (const auto& [width, height] : {std::array{32u, 32u}, std::array{21u, 13u}, std::array{5u, 70u}})
        {
            const ImageRecord image = makeRecord(24, 17, TexelFormat::rgba8_unorm);
            const std::vector<std::byte> texels = randomBytes(24 * 17 * 4, 5);
            const std::vector<std::byte> normals = filled(width, height, normal);
            RoughnessFilter filter(
                {normalRecord(width, height, TexelFormat::rgba8_unorm), normals, 1.5f, 0.3f});
            EXPECT_EQ(buildMipChain(image, texels, 16, &filter), buildMipChain(image, texels));
        }
}

/// Mean of unit normals over an area, each weighted by its share of it: the slow way.
double meanLength(const std::vector<Rgba8>& normals, uint32_t width, uint32_t height,
                  const std::array<double, 4>& area)
{
    Normal sum{};
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
        {
            const double across = std::min(area[1], x + 1.0) - std::max(area[0], 1.0 * x);
            const double down = std::min(area[3], y + 1.0) - std::max(area[2], 1.0 * y);
            if (across <= 0 || down <= 0)
                continue;
            Normal n;
            for (size_t c = 0; c < 3; ++c)
                n[c] = normals[size_t{y} * width + x][c] / 127.5 - 1;
            n[2] = std::max(n[2], 0.0);
            const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            for (size_t c = 0; c < 3; ++c)
                sum[c] += n[c] / length * across * down;
        }
    const double whole = (area[1] - area[0]) * (area[3] - area[2]);
    return std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / whole;
}

/// Return the multiple of the variance of normals that the nearest lobe has more, from a table of minima
/// that was made by numerical integration over slopes.
double nearestWeight(double sigma_by_alpha)
{
    constexpr std::array<std::array<double, 2>, 9> kTable{{{0, 2.09},
                                                           {0.5, 2.09},
                                                           {1, 1.99},
                                                           {1.5, 1.86},
                                                           {2, 1.76},
                                                           {3, 1.69},
                                                           {4, 1.65},
                                                           {6, 1.59},
                                                           {8, 1.57}}};
    for (size_t i = 1; i < kTable.size(); ++i)
        if (sigma_by_alpha < kTable[i][0])
            return std::lerp(kTable[i - 1][1], kTable[i][1],
                             (sigma_by_alpha - kTable[i - 1][0]) / (kTable[i][0] - kTable[i - 1][0]));
    return 1.56;
}

TEST(RoughnessFilter, everyTexelLosesTheNormalsOfItsArea)
{
    constexpr uint32_t kWidth = 16, kHeight = 8;
    ImageRecord image = makeRecord(kWidth, kHeight, TexelFormat::rgba8_unorm);
    image.mip_count = fullMipCount(kWidth, kHeight);
    const std::vector<std::byte> texels = filled(kWidth, kHeight, {0, 26, 0, 255});
    for (const auto& [width, height] : {std::array{64u, 32u}, std::array{16u, 8u}, std::array{23u, 9u},
                                        std::array{3u, 2u}, std::array{4u, 40u}})
    {
        const ImageRecord normal_record = normalRecord(width, height, TexelFormat::rgba8_unorm);
        const std::vector<std::byte> bytes = randomBytes(size_t{width} * height * 4, width);
        const std::vector<Rgba8> normals = decodeMip(normal_record, bytes, 0);
        RoughnessFilter filter({normal_record, bytes, 1, 1});
        const std::vector<std::byte> chain = buildMipChain(image, texels, 16, &filter);
        EXPECT_TRUE(std::equal(texels.begin(), texels.end(), chain.begin())) << "the finest mip";
        for (uint32_t mip = 1; mip < image.mip_count; ++mip)
        {
            const auto [w, h] = formats::mipExtent(image, mip);
            const std::vector<Rgba8> roughness = decodeMip(image, chain, mip);
            for (uint32_t i = 0; i < w * h && !(w >= width && h >= height); ++i)
            {
                const std::array<double, 4> area{1.0 * (i % w) * width / w, (i % w + 1.0) * width / w,
                                                 1.0 * (i / w) * height / h, (i / w + 1.0) * height / h};
                const double rho = meanLength(normals, width, height, area);
                const double spread = (1 - rho * rho) / (rho * (3 - rho * rho));
                const double alpha2 = std::pow(26 / 255.0, 4);
                const double weight = nearestWeight(std::sqrt(spread / alpha2));
                const double expected = std::pow(std::min(1.0, alpha2 + weight * spread), 0.25) * 255;
                // mips are made from mips, whose edges may lie inside of an area: the fits are not exact then
                const bool is_nested = width % w == 0 && height % h == 0;
                EXPECT_NEAR(roughness[i][1], expected, is_nested ? 1.5 : 24)
                    << width << ' ' << mip << ' ' << i;
            }
        }
    }
}

TEST(RoughnessFilter, sameBytesForAnyNumberOfThreads)
{
    const ImageRecord image = makeRecord(200, 130, TexelFormat::rgba8_unorm);
    const std::vector<std::byte> texels = randomBytes(200 * 130 * 4, 1);
    const std::vector<std::byte> normals = randomBytes(256 * 256 * 4, 2);
    const auto build = [&](size_t threads)
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        RoughnessFilter filter({normalRecord(256, 256, TexelFormat::rgba8_unorm), normals, 1, 1});
        return buildMipChain(image, texels, 16, &filter);
    };
    EXPECT_EQ(build(1), build(7));
}

} // namespace

} // namespace hearth::textures
