// Tests the harmonics of distant light, and the light of occluders under them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "formats/gpu_shared/record_values.h"
#include "formats/scene/radiance_transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace hearth::shared
{
namespace
{

constexpr double kPi = std::numbers::pi;

/// Integrate over the sphere: midpoints of equal solid angles.
double integrate(const std::function<double(Float3)>& function)
{
    constexpr int kHeights = 200, kTurns = 400;
    double sum = 0;
    for (int i = 0; i < kHeights; ++i)
        for (int j = 0; j < kTurns; ++j)
        {
            const double y = 1 - (2 * i + 1.0) / kHeights, turn = 2 * kPi * (j + 0.5) / kTurns;
            const double across = std::sqrt(1 - y * y);
            sum += function({static_cast<float>(across * std::cos(turn)), static_cast<float>(y),
                             static_cast<float>(across * std::sin(turn))});
        }
    return sum * 4 * kPi / (kHeights * kTurns);
}

TEST(LightHarmonics, areOrthonormal)
{
    for (uint32_t i = 0; i < formats::kLightHarmonics; ++i)
        for (uint32_t j = 0; j <= i; ++j)
            EXPECT_NEAR(integrate(
                            [&](Float3 d)
                            {
                                const auto harmonics = evaluateHarmonics(d);
                                return double{harmonics[i]} * double{harmonics[j]};
                            }),
                        i == j ? 1 : 0, 5e-4)
                << i << " " << j;
}

TEST(LightHarmonics, ofTheSkyAreItsIntegrals)
{
    constexpr Sky kSky{{0.3f, 0.4f, 0.6f}, {0.5f, 0.45f, 0.4f}, {0.12f, 0.1f, 0.08f}};
    const LightHarmonics light = projectDistantLight(kSky, {});
    for (uint32_t i = 0; i < formats::kLightHarmonics; ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(
                light[i][c],
                integrate([&](Float3 d)
                          { return double{skyRadiance(kSky, d)[c]} * double{evaluateHarmonics(d)[i]}; }),
                2e-3)
                << i << " " << c;
}

/// A surface's irradiance from a sun, by nine harmonics: 1 / 4 + cos / 2 + 5 / 32 (3 cos cos - 1) of it
/// (R. Ramamoorthi, P. Hanrahan, "An efficient representation for irradiance environment maps", 2001).
TEST(LightHarmonics, haveTheSunsAndNoLamps)
{
    Light sun{}, lamp{};
    sun.type = kLightDirectional;
    sun.direction = normalize(Float3{0.5f, -0.8f, 0.3f});
    sun.intensity = {3, 2, 1};
    lamp.type = kLightPoint;
    lamp.intensity = {100, 100, 100};
    const Light lights[] = {lamp, sun};
    const LightHarmonics light = projectDistantLight(Sky{}, lights);
    const double bands[] = {kPi, 2 * kPi / 3, kPi / 4};
    for (const Float3 normal : {Float3{0, 1, 0}, normalize(Float3{1, 2, -3}), normalize(Float3{-2, 1, 0.5f})})
    {
        const auto harmonics = evaluateHarmonics(normal);
        double irradiance = 0;
        for (uint32_t i = 0; i < formats::kLightHarmonics; ++i)
            irradiance += bands[i == 0 ? 0 : i < 4 ? 1 : 2] * double{light[i].x} * double{harmonics[i]};
        const double cosine = -double{dot(normal, sun.direction)};
        EXPECT_NEAR(irradiance, 3 * (0.25 + cosine / 2 + 5.0 / 32 * (3 * cosine * cosine - 1)), 1e-5);
    }
}

TEST(OccluderLight, isTheSumOfHarmonicsAndTerms)
{
    formats::RadianceTransferRecord transfer{};
    const auto value = [](uint32_t harmonic, uint32_t term, int color)
    {
        return static_cast<float>(harmonic + 1) / 8 + static_cast<float>(term) / 4 -
               static_cast<float>(color) / 2;
    };
    for (uint32_t harmonic = 0; harmonic < formats::kLightHarmonics; ++harmonic)
        for (uint32_t term = 0; term < formats::kDirectionTerms; ++term)
            for (int color = 0; color < 3; ++color)
                transfer.values[formats::transferValue(harmonic, term, static_cast<uint32_t>(color))] =
                    halfFromFloat(value(harmonic, term, color));
    LightHarmonics light{};
    for (uint32_t i = 0; i < light.size(); ++i)
        light[i] = Float3{0.5f, 0.25f, 1} * static_cast<float>(i % 3);
    const Float3 direction{0.1f, -0.4f, 0.7f};
    const float terms[] = {direction.x, direction.y, direction.z, 1};
    const Float3 found = occluderRadiance(transferLight(transfer, light), direction);
    for (int color = 0; color < 3; ++color)
    {
        float expected = 0;
        for (uint32_t harmonic = 0; harmonic < formats::kLightHarmonics; ++harmonic)
            for (uint32_t term = 0; term < formats::kDirectionTerms; ++term)
                expected += light[harmonic][color] * value(harmonic, term, color) * terms[term];
        EXPECT_NEAR(found[color], std::max(expected, 0.0f), 1e-4f);
    }
}

TEST(OccluderLight, isNeverNegative)
{
    const OccluderLight light{{-1, 0, 0, 0.5f}, {0, -1, 0, 0.5f}, {0, 0, 1, -0.2f}};
    EXPECT_EQ(occluderRadiance(light, {1, 1, 0}), (Float3{0, 0, 0}));
}

/// Half of the hemisphere is visible: the other half's mean direction is its mirror image.
TEST(OccluderLight, comesFromTheMeanOfOccludedDirections)
{
    const float pi = kVisibilityPi;
    const Float3 visible{pi / 2, 0, pi / 2};
    const Float3 found = meanOccludedDirection(pi, visible, {0, 0, 1});
    EXPECT_NEAR(found.x, -0.5f, 1e-6f);
    EXPECT_NEAR(found.y, 0, 1e-6f);
    EXPECT_NEAR(found.z, 0.5f, 1e-6f);
}

} // namespace
} // namespace hearth::shared
