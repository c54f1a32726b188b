// Tests daylight against Preetham's luminances, summed by random directions, and against what skies do.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/daylight.h"

#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/sky.h"
#include "formats/scene/scene_lighting.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace hearth::test
{

namespace
{

using shared::Daylight;
using shared::DaylightColors;

constexpr double kPi = std::numbers::pi;

/// Return the irradiance of level ground below the gradient alone.
Float3 skyIrradiance(const DaylightColors& colors)
{
    const shared::Sky sky{.zenith = colors.zenith, .horizon = colors.horizon, .ground = colors.ground};
    constexpr int kSteps = 2000;
    Float3 sum{};
    for (int i = 0; i < kSteps; ++i)
    {
        const float height = (static_cast<float>(i) + 0.5f) / kSteps;
        const Float3 direction{std::sqrt(1 - height * height), height, 0};
        sum = sum + shared::skyRadiance(sky, direction) * (2 * static_cast<float>(kPi) * height / kSteps);
    }
    return sum;
}

/// Return the luminance of a direction over that of the zenith.
/// source  Preetham, appendix 2, for a turbidity of 3
double relativeLuminance(double zenith_angle, double sun_angle, double sun_zenith_angle)
{
    const auto perez = [](double theta, double gamma)
    {
        const double cos_gamma = std::cos(gamma);
        return (1 - 0.9269 * std::exp(-0.6387 / std::cos(theta))) *
               (1 + 5.2570 * std::exp(-2.2153 * gamma) + 0.1693 * cos_gamma * cos_gamma);
    };
    return perez(zenith_angle, sun_angle) / perez(0, sun_zenith_angle);
}

/// Return the illuminance of level ground below a sky of turbidity 3, in lux: a sum of random directions.
double modelIlluminance(double elevation_deg)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    const double sun = (90 - elevation_deg) * kPi / 180;
    double sum = 0; // directions by the cosine of their angle from the zenith
    constexpr int kDirections = 400'000;
    for (int i = 0; i < kDirections; ++i)
    {
        const double sine = std::sqrt(unit(random)), azimuth = 2 * kPi * unit(random);
        const double theta = std::asin(std::min(sine, 0.9999));
        const double cos_gamma = std::cos(sun) * std::cos(theta) + std::sin(sun) * sine * std::cos(azimuth);
        sum += relativeLuminance(theta, std::acos(std::clamp(cos_gamma, -1.0, 1.0)), sun);
    }
    const double chi = (4.0 / 9 - 3.0 / 120) * (kPi - 2 * sun);
    const double zenith = 1000 * ((4.0453 * 3 - 4.9710) * std::tan(chi) - 0.2155 * 3 + 2.4192); // cd/m2
    return kPi * zenith * sum / kDirections;
}

float bluerThan(Float3 color, Float3 other)
{
    return color.z / color.x - other.z / other.x;
}

} // namespace

TEST(Daylight, groundGetsWhatTheModelGives)
{
    const DaylightColors clear = shared::makeDaylight({.elevation_deg = 45, .turbidity = 3});
    const double exposed = double{shared::luminance(skyIrradiance(clear))};
    const double lux = modelIlluminance(45);
    // a clear sun of 45 degrees gives 75,000 to 105,000 lux
    const double exposure = double{shared::luminance(clear.sun_illuminance)};
    EXPECT_GT(exposed, exposure / 105'000 * lux);
    EXPECT_LT(exposed, exposure / 75'000 * lux);
    for (const double elevation : {2.0, 10.0, 30.0, 60.0, 85.0})
    {
        const DaylightColors colors =
            shared::makeDaylight({.elevation_deg = static_cast<float>(elevation), .turbidity = 3});
        const double ratio = double{shared::luminance(skyIrradiance(colors))} / exposed;
        EXPECT_NEAR(ratio, modelIlluminance(elevation) / lux, 0.02 * ratio) << elevation;
    }
}

TEST(Daylight, sunIsAsBrightAsThatOfScenesWithoutLights)
{
    const DaylightColors clear = shared::makeDaylight({.elevation_deg = 45, .turbidity = 3});
    EXPECT_NEAR(shared::luminance(clear.sun_illuminance), shared::luminance(shared::kSunIlluminance), 1e-5f);
    const float diffuse = shared::luminance(skyIrradiance(clear));
    const float direct = shared::luminance(clear.sun_illuminance) * std::sqrt(0.5f);
    EXPECT_GT(diffuse / (diffuse + direct), 0.12f) << "clear skies give an eighth to a third of the light";
    EXPECT_LT(diffuse / (diffuse + direct), 0.35f);
}

TEST(Daylight, groundReflectsAFifth)
{
    const DaylightColors colors = shared::makeDaylight({.elevation_deg = 30});
    const Float3 light = skyIrradiance(colors) + colors.sun_illuminance * 0.5f;
    EXPECT_NEAR(colors.ground.x, 0.2f / static_cast<float>(kPi) * light.x, 0.01f * colors.ground.x);
    EXPECT_NEAR(colors.ground.y, 0.2f / static_cast<float>(kPi) * light.y, 0.01f * colors.ground.y);
    EXPECT_NEAR(colors.ground.z, 0.2f / static_cast<float>(kPi) * light.z, 0.01f * colors.ground.z);
}

TEST(Daylight, theSunReddensAndDimsAsItSinks)
{
    for (const float turbidity : {2.5f, 3.0f, 6.0f, 8.0f})
    {
        DaylightColors higher = shared::makeDaylight({.elevation_deg = 90, .turbidity = turbidity});
        for (float elevation = 85; elevation >= 0; elevation -= 5)
        {
            const DaylightColors lower =
                shared::makeDaylight({.elevation_deg = elevation, .turbidity = turbidity});
            EXPECT_LT(bluerThan(lower.sun_illuminance, higher.sun_illuminance), 0) << elevation;
            EXPECT_LT(shared::luminance(lower.sun_illuminance), shared::luminance(higher.sun_illuminance));
            higher = lower;
        }
        EXPECT_GT(higher.sun_illuminance.x, 2 * higher.sun_illuminance.y) << "at the horizon it is red";
    }
}

TEST(Daylight, clearSkiesAreBlueAboveAndPaleBelow)
{
    for (const float elevation : {20.0f, 40.0f, 60.0f})
    {
        const DaylightColors clear = shared::makeDaylight({.elevation_deg = elevation, .turbidity = 2.5f});
        const DaylightColors hazy = shared::makeDaylight({.elevation_deg = elevation, .turbidity = 8});
        EXPECT_GT(clear.zenith.z, 1.5f * clear.zenith.x) << elevation;
        EXPECT_GT(bluerThan(clear.zenith, clear.horizon), 0) << elevation;
        EXPECT_GT(bluerThan(clear.zenith, hazy.zenith), 0) << elevation;
        EXPECT_LT(shared::luminance(hazy.sun_illuminance), shared::luminance(clear.sun_illuminance));
    }
}

TEST(Daylight, isFiniteAndNotNegativeWhereverTheSunIs)
{
    for (float elevation = 0; elevation <= 90; elevation += 3)
        for (float turbidity = 2.5f; turbidity <= 8; turbidity += 0.5f)
        {
            const DaylightColors colors =
                shared::makeDaylight({.elevation_deg = elevation, .turbidity = turbidity});
            for (const Float3& color : {colors.sun_illuminance, colors.zenith, colors.horizon, colors.ground})
                for (const float value : {color.x, color.y, color.z})
                {
                    EXPECT_TRUE(std::isfinite(value)) << elevation << ' ' << turbidity;
                    EXPECT_GE(value, 0) << elevation << ' ' << turbidity;
                }
            EXPECT_GT(shared::luminance(skyIrradiance(colors)), 0.0f) << elevation << ' ' << turbidity;
        }
}

TEST(Daylight, raysComeFromWhereTheSunIs)
{
    const auto expect_direction = [](const Daylight& daylight, Float3 expected)
    {
        const Float3 direction = shared::makeDaylight(daylight).sun_direction;
        EXPECT_NEAR(direction.x, expected.x, 1e-6f);
        EXPECT_NEAR(direction.y, expected.y, 1e-6f);
        EXPECT_NEAR(direction.z, expected.z, 1e-6f);
    };
    expect_direction({.elevation_deg = 90, .azimuth_deg = 77}, {0, -1, 0});
    expect_direction({.elevation_deg = 0, .azimuth_deg = 0}, {0, 0, 1});
    expect_direction({.elevation_deg = 0, .azimuth_deg = 90}, {-1, 0, 0});
    expect_direction({.elevation_deg = 30, .azimuth_deg = 180}, {0, -0.5f, -std::sqrt(0.75f)});
}

TEST(Daylight, valuesBeyondTheirRangesAreRefused)
{
    EXPECT_TRUE(shared::checkDaylight({.elevation_deg = 0, .azimuth_deg = -400, .turbidity = 2.5f}).ok());
    EXPECT_TRUE(shared::checkDaylight({.elevation_deg = 90, .azimuth_deg = 0, .turbidity = 8}).ok());
    const auto fault = [](const Daylight& daylight)
    { return shared::checkDaylight(daylight).error().detail; };
    EXPECT_THAT(fault({.elevation_deg = -0.1f}), testing::HasSubstr("elevation"));
    EXPECT_THAT(fault({.elevation_deg = 90.1f}), testing::HasSubstr("elevation"));
    EXPECT_THAT(fault({.elevation_deg = NAN}), testing::HasSubstr("elevation"));
    EXPECT_THAT(fault({.azimuth_deg = INFINITY}), testing::HasSubstr("azimuth"));
    EXPECT_THAT(fault({.turbidity = 2.4f}), testing::HasSubstr("turbidity"));
    EXPECT_THAT(fault({.turbidity = 8.1f}), testing::HasSubstr("turbidity"));
}

} // namespace hearth::test
