// Tests the mips of probes against sums over many points of the environment.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/probes/harmonics.h"
#include "cook/probes/prefilter.h"
#include "tests/environments/environments.h"
#include "tests/environments/lobe_sum.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <numbers>
#include <numeric>

namespace hearth::probes
{

namespace
{

using environment::Environment;
using environment::Layout;
using test::averageMip;
using test::makeEnvironment;
using test::makeNoise;
using test::sumLobe;
using test::texelDirection;

constexpr double kPi = std::numbers::pi;
constexpr uint32_t kMips = 6;
constexpr Double3 kSun{0.48, 0.6, 0.64};

/// Filter a small probe. rows  of the tree; the default suits the side as the cooker's rows suit its side
std::vector<ProbeMip> filter(const Environment& sky, uint32_t side = 32, uint32_t rows = 32 * kTreeRowsOfSide)
{
    return prefilter(buildRadianceTree(sky, 1, rows), side, kMips);
}

/// Error of some texels of a mip against sums, as a share of the rms of the sums. Every second texel is
/// the nearest of all to the sun, the next nearest, and so on.
double measureError(const Environment& sky, const ProbeMip& mip, double roughness, uint32_t steps,
                    size_t count)
{
    std::vector<size_t> by_sun(mip.texels.size());
    std::iota(by_sun.begin(), by_sun.end(), size_t{0});
    std::sort(by_sun.begin(), by_sun.end(),
              [&](size_t a, size_t b)
              { return dot(texelDirection(mip, a), kSun) > dot(texelDirection(mip, b), kSun); });
    std::mt19937 random(7);
    double error = 0, size = 0;
    for (size_t i = 0; i < count; ++i)
    {
        const size_t texel = i % 2 == 0 ? by_sun[i / 2 % by_sun.size()] : random() % mip.texels.size();
        const Double3 expected = sumLobe(sky, steps, texelDirection(mip, texel), roughness);
        const Double3 difference = mip.texels[texel] - expected;
        error += dot(difference, difference);
        size += dot(expected, expected);
    }
    return std::sqrt(error / size);
}

/// Sky with a sun of four degrees, a horizon, clouds and a dark ground.
Float3 radianceOfDay(Double3 d)
{
    if (dot(d, kSun) > 0.9994)
        return {2000, 1800, 1500};
    if (d.y < 0)
        return {0.1f, 0.09f, static_cast<float>(0.08 + 0.02 * std::sin(30 * d.x))};
    return {static_cast<float>(0.3 + 0.2 * std::sin(20 * d.x + 9 * d.z)), static_cast<float>(0.5 - 0.2 * d.y),
            static_cast<float>(1 - 0.3 * d.y)};
}

} // namespace

TEST(Prefilter, keepsOneRadianceInEveryMip)
{
    for (const Layout layout : {Layout::lat_long, Layout::cube})
        for (const uint32_t height : {2u, 48u})
            for (const ProbeMip& mip : filter(makeEnvironment(layout, height,
                                                              [](Double3) {
                                                                  return Float3{3, 0.7f, 65000};
                                                              })))
                for (const Double3& texel : mip.texels)
                {
                    ASSERT_NEAR(texel.x, 3, 3e-7);
                    ASSERT_NEAR(texel.y, 0.7, 1e-7);
                    ASSERT_NEAR(texel.z, 65000, 7e-3);
                }
}

TEST(Prefilter, attenuatesDegree1AsTheLobeDoes)
{
    // integrals of k cos t / integrals of k, at the roughness of each mip: by 200,000 midpoints
    const Double3 up{0.6, 0.64, 0.48};
    const std::vector<ProbeMip> mips =
        filter(makeEnvironment(Layout::lat_long, 512,
                               [&](Double3 d) {
                                   return Float3{static_cast<float>(1 + 0.8 * dot(d, up)), 1, 1};
                               }));
    for (uint32_t m = 1; m < kMips; ++m)
    {
        const double roughness = 1 - std::sqrt(1 - m / 5.0), alpha2 = std::pow(roughness, 4);
        double above = 0, below = 0;
        constexpr int kSteps = 200000;
        for (int i = 0; i < kSteps; ++i)
        {
            const double cosine = (i + 0.5) / kSteps, spread = (1 + cosine) / 2 * (alpha2 - 1) + 1;
            const double k = cosine / (spread * spread);
            above += k * cosine;
            below += k;
        }
        const double attenuation = above / below;
        for (size_t i = 0; i < mips[m].texels.size(); ++i)
            ASSERT_NEAR(mips[m].texels[i].x, 1 + 0.8 * attenuation * dot(texelDirection(mips[m], i), up),
                        1e-3)
                << "mip " << m;
    }
    // the design's figure of a Lambert lobe
    for (size_t i = 0; i < mips[5].texels.size(); ++i)
        ASSERT_NEAR(mips[5].texels[i].x, 1 + 0.8 * 2 / 3 * dot(texelDirection(mips[5], i), up), 1e-3);
}

TEST(Prefilter, isTheSumOverManyPoints)
{
    const Environment day = makeEnvironment(Layout::lat_long, 128, radianceOfDay);
    const std::vector<ProbeMip> mips = filter(day, 32, 1024);
    for (uint32_t m = 1; m < kMips; ++m)
    {
        // points a sixth of alpha apart, or closer
        const double roughness = 1 - std::sqrt(1 - m / 5.0);
        const uint32_t steps = m == 1 ? 14 : m == 2 ? 4 : 2;
        const double error = measureError(day, mips[m], roughness, steps, test::trials(m == 1 ? 8 : 24));
        EXPECT_LT(error, 0.006) << "mip " << m;
        RecordProperty("mip" + std::to_string(m), std::to_string(error));
    }
}

TEST(Prefilter, keepsTheMeanOfASkyWithASun)
{
    const Environment day = makeEnvironment(Layout::lat_long, 256, radianceOfDay);
    const Double3 mean = meanIrradiance(projectRadiance(day)) * (1 / kPi);
    const std::vector<ProbeMip> mips = filter(day, 64, 512);
    for (uint32_t m = 0; m < kMips; ++m)
    {
        // from mip 3 on texels are farther apart than lobes are wide: their mean is off where they are,
        // not their light
        const double tolerance = m == 0 ? 3e-3 : m < 3 ? 6e-3 : 0.025;
        const Double3 got = averageMip(mips[m]);
        EXPECT_NEAR(got.x / mean.x, 1, tolerance) << "mip " << m;
        EXPECT_NEAR(got.z / mean.z, 1, tolerance) << "mip " << m;
    }
}

TEST(Prefilter, quarterTurnsPermuteFaces)
{
    // Face of a cube turned by a quarter about +Y that shows what +X, +Z, -X, -Z showed: each the next.
    const Environment sky = makeNoise(Layout::lat_long, 32, 4);
    Environment turned = sky;
    for (uint32_t y = 0; y < sky.height; ++y)
        for (uint32_t x = 0; x < sky.width; ++x)
            turned.texels[turned.index(0, (x + sky.width / 4) % sky.width, y)] =
                sky.texels[sky.index(0, x, y)];
    const std::vector<ProbeMip> before = filter(sky), after = filter(turned);
    // the image moves a quarter to the right: from +X (a quarter from the left) to +Z (the middle), then
    // to -X
    constexpr uint32_t kFrom[] = {0, 4, 1, 5}, kTo[] = {4, 1, 5, 0};
    for (uint32_t m = 0; m < kMips; ++m)
    {
        const size_t face = size_t{before[m].side} * before[m].side;
        for (uint32_t turn = 0; turn < 4; ++turn)
            for (size_t i = 0; i < face; ++i)
            {
                const Double3 expected = before[m].texels[kFrom[turn] * face + i];
                const Double3 got = after[m].texels[kTo[turn] * face + i];
                ASSERT_NEAR(got.x, expected.x, 2e-3 * expected.x + 1e-3) << "mip " << m << " texel " << i;
            }
    }
}

TEST(Prefilter, cubesAgreeWithLatLong)
{
    const auto smooth = [](Double3 d) {
        return Float3{static_cast<float>(1 + 0.5 * d.x + 0.4 * d.y * d.z), static_cast<float>(1 + 0.9 * d.z),
                      1};
    };
    const std::vector<ProbeMip> from_cube = filter(makeEnvironment(Layout::cube, 128, smooth));
    const std::vector<ProbeMip> from_image = filter(makeEnvironment(Layout::lat_long, 256, smooth));
    for (uint32_t m = 0; m < kMips; ++m)
        for (size_t i = 0; i < from_cube[m].texels.size(); ++i)
        {
            ASSERT_NEAR(from_cube[m].texels[i].x, from_image[m].texels[i].x, 0.01) << "mip " << m;
            ASSERT_NEAR(from_cube[m].texels[i].y, from_image[m].texels[i].y, 0.01) << "mip " << m;
        }
}

TEST(Prefilter, doesNotDependOnThreads)
{
    const Environment sky = makeNoise(Layout::lat_long, 16, 2);
    const auto run = [&](size_t threads)
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return filter(sky);
    };
    const std::vector<ProbeMip> one = run(1), four = run(4);
    for (uint32_t m = 0; m < kMips; ++m)
        EXPECT_EQ(
            std::memcmp(one[m].texels.data(), four[m].texels.data(), one[m].texels.size() * sizeof(Double3)),
            0)
            << m;
}

} // namespace hearth::probes
