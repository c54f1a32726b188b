// Tests the harmonics of environments against sums over many points.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/probes/harmonics.h"
#include "formats/scene/radiance_transfer.h"
#include "tests/environments/environments.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstring>
#include <numbers>

namespace hearth::probes
{

namespace
{

using environment::Environment;
using environment::Layout;
using test::makeEnvironment;
using test::makeNoise;

constexpr double kPi = std::numbers::pi;

/// Calls add(direction, solid angle, radiance) for `steps` x `steps` points of each texel, with the surface
/// element of the sphere.
template <typename Add>
void forEachPoint(const Environment& sky, int steps, Add&& add)
{
    const double rows = double(sky.height) * steps, columns = double(sky.width) * steps;
    for (uint32_t panel = 0; panel < sky.panelCount(); ++panel)
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x)
            {
                const double u = (x + 0.5) / columns, v = (y + 0.5) / rows;
                const double a = 2 * u - 1, b = 2 * v - 1;
                const double solid_angle = sky.layout == Layout::cube
                                               ? 4 / (rows * columns) / std::pow(1 + a * a + b * b, 1.5)
                                               : 2 * kPi * kPi / (rows * columns) * std::sin(kPi * v);
                add(panelDirection(sky.layout, panel, {u, v}), solid_angle,
                    sky.texels[sky.index(panel, static_cast<uint32_t>(x / steps),
                                         static_cast<uint32_t>(y / steps))]);
            }
}

void expectNear(Double3 got, Double3 expected, double tolerance, size_t what)
{
    EXPECT_NEAR(got.x, expected.x, tolerance) << what;
    EXPECT_NEAR(got.y, expected.y, tolerance) << what;
    EXPECT_NEAR(got.z, expected.z, tolerance) << what;
}

Double3 randomDirection(std::mt19937& random)
{
    const auto number = [&] { return static_cast<double>(random()) / 4294967296.0; };
    const double y = 2 * number() - 1, longitude = 2 * kPi * number(), r = std::sqrt(1 - y * y);
    return {r * std::cos(longitude), y, r * std::sin(longitude)};
}

/// Least irradiance over a grid of normals, about a degree apart.
double searchMinIrradiance(const Harmonics& radiance)
{
    double min = 1e30;
    for (int y = 0; y < 180; ++y)
        for (int x = 0; x < 360; ++x)
        {
            const Double3 e = harmonicIrradiance(
                radiance, panelDirection(Layout::lat_long, 0, {(x + 0.5) / 360, (y + 0.5) / 180}));
            min = std::min({min, e.x, e.y, e.z});
        }
    return min;
}

} // namespace

TEST(ProjectRadiance, isTheSumOverManyPoints)
{
    for (const Layout layout : {Layout::lat_long, Layout::cube})
    {
        const Environment sky = makeNoise(layout, layout == Layout::cube ? 6 : 9, 3);
        Harmonics expected{};
        forEachPoint(sky, 40,
                     [&](Double3 direction, double solid_angle, Float3 radiance)
                     {
                         const auto harmonics = shared::evaluateHarmonics(narrow(direction));
                         for (size_t i = 0; i < expected.size(); ++i)
                             expected[i] =
                                 expected[i] + widen(radiance) * (solid_angle * double{harmonics[i]});
                     });
        const Harmonics got = projectRadiance(sky);
        const double scale = length(expected[0]);
        for (size_t i = 0; i < got.size(); ++i)
            expectNear(got[i], expected[i], (layout == Layout::cube ? 2e-3 : 3e-4) * scale, i);
    }
}

TEST(ProjectRadiance, ofOneRadianceHasDegree0Alone)
{
    for (const Layout layout : {Layout::lat_long, Layout::cube})
    {
        const Harmonics got = projectRadiance(makeEnvironment(layout, 32,
                                                              [](Double3) {
                                                                  return Float3{3, 2, 0.5f};
                                                              }));
        expectNear(meanIrradiance(got), {3 * kPi, 2 * kPi, 0.5 * kPi}, 1e-12, 0);
        for (size_t i = 1; i < got.size(); ++i)
            expectNear(got[i], {}, layout == Layout::cube ? 2e-6 : 1e-12, i);
        EXPECT_NEAR(minIrradiance(got), 0.5 * kPi, 1e-5);
    }
}

TEST(ProjectRadiance, doesNotDependOnThreads)
{
    const Environment sky = makeNoise(Layout::lat_long, 64, 1);
    const auto project = [&](size_t threads)
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return projectRadiance(sky);
    };
    const Harmonics one = project(1), four = project(4);
    EXPECT_EQ(std::memcmp(one.data(), four.data(), sizeof(one)), 0);
}

TEST(HarmonicIrradiance, isTheIntegralForASkyOfFewDegrees)
{
    const auto radiance = [](Double3 d)
    {
        return Float3{static_cast<float>(1 + 0.5 * d.x - 0.3 * d.y + 0.2 * d.z * d.y),
                      static_cast<float>(2 + d.x * d.x - 0.5 * d.z * d.z + 0.3 * d.x * d.y),
                      static_cast<float>(0.7 + 0.4 * d.y * d.y + 0.1 * d.x * d.z)};
    };
    const Environment sky = makeEnvironment(Layout::lat_long, 128, radiance);
    const Harmonics harmonics = projectRadiance(sky);
    std::mt19937 random(5);
    for (int i = 0; i < 20; ++i)
    {
        const Double3 normal = randomDirection(random);
        Double3 expected;
        forEachPoint(sky, 1,
                     [&](Double3 direction, double solid_angle, Float3 light) {
                         expected =
                             expected + widen(light) * (solid_angle * std::max(0.0, dot(direction, normal)));
                     });
        expectNear(harmonicIrradiance(harmonics, normal), expected, 0.002 * expected.x, 0);
    }
}

TEST(MinIrradiance, isFoundByNoGrid)
{
    for (uint32_t seed = 0; seed < 12; ++seed)
    {
        // few texels: far from constant, so that the least irradiance is negative for some
        const Harmonics radiance = projectRadiance(makeNoise(Layout::lat_long, 2 + seed % 5, seed));
        const double searched = searchMinIrradiance(radiance), found = minIrradiance(radiance);
        EXPECT_LE(found, searched + 1e-9 * length(radiance[0])) << seed;
        EXPECT_NEAR(found, searched, 2e-3 * length(radiance[0])) << seed;
    }
    // a sky that is the same to both sides: the linear part is at a right angle to the least eigenvector
    const Harmonics bands =
        projectRadiance(makeEnvironment(Layout::lat_long, 64,
                                        [](Double3 d) {
                                            return std::abs(d.x) > 0.9 ? Float3{9, 8, 9} : Float3{};
                                        }));
    EXPECT_NEAR(minIrradiance(bands), searchMinIrradiance(bands), 2e-3 * length(bands[0]));
}

TEST(WindowHarmonics, isTheLeastThatMakesASunPositive)
{
    const Harmonics sun =
        projectRadiance(makeEnvironment(Layout::lat_long, 64,
                                        [](Double3 d) {
                                            return d.x + d.y > 1.4 ? Float3{900, 800, 700} : Float3{};
                                        }));
    EXPECT_LT(searchMinIrradiance(sun), 0);
    const WindowedHarmonics windowed = windowHarmonics(sun);
    EXPECT_GT(windowed.window, 0);
    EXPECT_GE(searchMinIrradiance(windowed.radiance), 0);
    EXPECT_LT(searchMinIrradiance(windowed.radiance), 1e-3 * length(sun[0]));
    EXPECT_EQ(length(windowed.radiance[0] - sun[0]), 0) << "the mean stays";
    const double degree1 = 1 / (1 + 4 * windowed.window), degree2 = 1 / (1 + 36 * windowed.window);
    EXPECT_NEAR(windowed.radiance[2].x, degree1 * sun[2].x, 1e-9 * sun[2].x);
    EXPECT_NEAR(windowed.radiance[5].y, degree2 * sun[5].y, 1e-9 * sun[5].y);
}

TEST(WindowHarmonics, leavesASmoothSky)
{
    const Harmonics sky =
        projectRadiance(makeEnvironment(Layout::lat_long, 32,
                                        [](Double3 d) {
                                            return Float3{1, 1, static_cast<float>(1.5 + d.y)};
                                        }));
    const WindowedHarmonics windowed = windowHarmonics(sky);
    EXPECT_EQ(windowed.window, 0);
    EXPECT_EQ(std::memcmp(&windowed.radiance, &sky, sizeof(sky)), 0);
}

} // namespace hearth::probes
