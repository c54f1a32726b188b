// Tests the light of the sky through cones against sums over its directions.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/double3.h"
#include "formats/scene/reflectance.h"
#include "formats/scene/sky_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace hearth::shared
{
namespace
{

// colours that differ more than those of the default sky
constexpr Sky kSky{{0.3f, 0.4f, 0.6f}, {0.5f, 0.45f, 0.4f}, {0.12f, 0.1f, 0.08f}};

/// Directions of equal solid angles.
const std::vector<Float3>& directions()
{
    static const std::vector<Float3> all = []
    {
        std::vector<Float3> found;
        constexpr int kHeights = 160, kTurns = 320;
        for (int i = 0; i < kHeights; ++i)
            for (int j = 0; j < kTurns; ++j)
            {
                const double y = 1 - (2 * i + 1.0) / kHeights,
                             turn = 2 * std::numbers::pi * (j + 0.5) / kTurns;
                const double across = std::sqrt(1 - y * y);
                found.push_back({static_cast<float>(across * std::cos(turn)), static_cast<float>(y),
                                 static_cast<float>(across * std::sin(turn))});
            }
        return found;
    }();
    return all;
}

/// Mean radiance of the sky by a weight of its directions.
struct Mean
{
    Double3 radiance;
    double weight = 0; ///< integral of the weight
};

Mean integrate(const std::function<float(Float3)>& weight)
{
    Mean mean;
    for (const Float3 direction : directions())
        if (const double w = double{weight(direction)}; w > 0)
        {
            const Float3 radiance = skyRadiance(kSky, direction);
            mean.radiance =
                mean.radiance + Double3{double{radiance.x}, double{radiance.y}, double{radiance.z}} * w;
            mean.weight += w;
        }
    mean.radiance = mean.radiance * (1 / mean.weight);
    mean.weight *= 4 * std::numbers::pi / static_cast<double>(directions().size());
    return mean;
}

/// Largest difference of a channel, relative.
double difference(Float3 found, const Double3& exact)
{
    return std::max({std::abs(double{found.x} / exact.x - 1), std::abs(double{found.y} / exact.y - 1),
                     std::abs(double{found.z} / exact.z - 1)});
}

Float3 randomDirection(std::mt19937& random)
{
    std::normal_distribution<float> number;
    return normalize(Float3{number(random), number(random), number(random)});
}

/// Visibility cone of what a surface sees, as a cooker bakes it: from the moments of the visible directions
/// above the horizon of the surface.
VisibilityCone bake(Float3 normal, const std::function<bool(Float3)>& sees)
{
    Double3 m1{0, 0, 0};
    double m0 = 0;
    for (const Float3 d : directions())
        if (dot(d, normal) > 0 && sees(d))
        {
            m0 += 1;
            m1 = m1 + Double3{double{d.x}, double{d.y}, double{d.z}};
        }
    const double area = 4 * std::numbers::pi / static_cast<double>(directions().size());
    return visibilityCone(static_cast<float>(m0 * area),
                          Float3{static_cast<float>(m1.x * area), static_cast<float>(m1.y * area),
                                 static_cast<float>(m1.z * area)},
                          normal);
}

/// Error of the diffuse light of the sky that a surface sees, relative.
double diffuseError(Float3 normal, const std::function<bool(Float3)>& sees)
{
    const Mean exact = integrate([&](Float3 d) { return sees(d) ? std::max(dot(d, normal), 0.0f) : 0.0f; });
    return difference(skyConeRadiance(kSky, visibleCosineCone(bake(normal, sees), normal)), exact.radiance);
}

} // namespace

TEST(SkyCone, isTheMeanOfItsDirections)
{
    double largest = 0;
    for (const float height : {-1.0f, -0.7f, -0.33f, -0.11f, 0.0f, 0.07f, 0.24f, 0.31f, 0.6f, 0.93f, 1.0f})
        for (const float cosine : {0.0f, 0.22f, 0.41f, 0.66f, 0.85f})
        {
            const Float3 axis{std::sqrt(1 - height * height), height, 0};
            const Mean exact = integrate([&](Float3 d) { return dot(d, axis) >= cosine ? 1.0f : 0.0f; });
            const double error = difference(skyConeRadiance(kSky, {axis, cosine}), exact.radiance);
            EXPECT_LT(error, 0.01) << height << ' ' << cosine; // half of it is of the sum's directions
            largest = std::max(largest, error);
        }
    std::printf("largest error of a cone %.4f\n", largest);
}

TEST(SkyCone, isTheRadianceOfADirectionIfItIsNarrow)
{
    for (const float height : {-1.0f, -0.29f, -0.1f, 0.0f, 0.13f, 0.31f, 0.5f, 1.0f})
    {
        const Float3 axis{std::sqrt(1 - height * height), height, 0};
        const Float3 exact = skyRadiance(kSky, axis), found = skyConeRadiance(kSky, {axis, 1});
        EXPECT_NEAR(found.x, exact.x, 0.002f);
        EXPECT_NEAR(found.z, exact.z, 0.002f);
    }
}

TEST(SkyCone, lightsAnOpenSurfaceLikeAllDirectionsByTheirCosine)
{
    for (const float height : {-1.0f, -0.6f, -0.2f, 0.0f, 0.3f, 0.7f, 1.0f})
    {
        const Float3 normal{std::sqrt(1 - height * height), height, 0};
        const Mean exact = integrate([&](Float3 d) { return std::max(dot(d, normal), 0.0f); });
        EXPECT_LT(difference(skyConeRadiance(kSky, cosineCone(normal)), exact.radiance), 0.03) << height;
        EXPECT_LT(diffuseError(normal, [](Float3) { return true; }), 0.03) << height;
    }
}

/// Half of the hemisphere about a wall's normal is ground, from which the sky's light does not come.
TEST(SkyCone, lightsWallsOnRealGroundWithinThreePercent)
{
    const auto aboveGround = [](Float3 d) { return d.y > 0; };
    EXPECT_LT(diffuseError({1, 0, 0}, aboveGround), 0.03);
    EXPECT_LT(diffuseError({0, 0, -1}, aboveGround), 0.03);
    EXPECT_LT(diffuseError(normalize(Float3{1, 1, 0}), aboveGround), 0.03) << "a roof";
    EXPECT_LT(diffuseError(normalize(Float3{1, -0.5f, 0}), aboveGround), 0.03) << "leaning forward";
    EXPECT_LT(diffuseError({1, 0, 0}, [](Float3 d) { return d.y > 0.2f; }), 0.03) << "before a hedge";
    EXPECT_LT(diffuseError({1, 0, 0}, [](Float3 d) { return d.y > 0 && d.z > 0; }), 0.04) << "beside a wall";
    EXPECT_LT(diffuseError({0, 1, 0}, [](Float3 d) { return d.z > 0; }), 0.02) << "the ground before a wall";
    EXPECT_LT(diffuseError({0, 1, 0}, [](Float3 d) { return d.y > 0.7f; }), 0.02) << "a pit";
}

/// Any cone of directions above the surface's horizon.
TEST(SkyCone, lightsSurfacesThroughAnyConeWithinFewPercent)
{
    std::mt19937 random(7);
    double squares = 0;
    int count = 0;
    for (int i = 0; i < 300; ++i)
    {
        const Float3 normal = randomDirection(random), axis = randomDirection(random);
        const float cosine = std::uniform_real_distribution<float>(-0.2f, 0.8f)(random);
        const auto sees = [&](Float3 d) { return dot(d, axis) > cosine; };
        if (integrate([&](Float3 d) { return sees(d) ? std::max(dot(d, normal), 0.0f) : 0.0f; }).weight < 0.3)
            continue; // a tenth of the open sky
        squares += std::pow(diffuseError(normal, sees), 2);
        ++count;
    }
    EXPECT_GT(count, 150);
    std::printf("rms error through %d cones %.4f\n", count, std::sqrt(squares / count));
    EXPECT_LT(std::sqrt(squares / count), 0.05);
}

/// GGX, height-correlated masking, without Fresnel.
TEST(SkyCone, isReflectedByLobesWithinFewPercent)
{
    std::mt19937 random(9);
    double squares = 0;
    int count = 0;
    for (int i = 0; i < 200; ++i)
    {
        const Float3 normal = randomDirection(random);
        Float3 view = randomDirection(random);
        const float facing = std::abs(dot(view, normal));
        view = dot(view, normal) < 0 ? view - normal * (2 * dot(view, normal)) : view;
        // narrower lobes fall between the directions of the sum
        const float roughness = std::uniform_real_distribution<float>(0.35f, 1.0f)(random);
        const float alpha2 = std::pow(roughness, 4.0f);
        if (facing < 0.1f)
            continue;
        const Mean exact = integrate(
            [&](Float3 d)
            {
                const float nl = dot(d, normal);
                if (nl <= 0)
                    return 0.0f;
                const float nh = dot(normalize(d + view), normal);
                return nl / std::pow(nh * nh * (alpha2 - 1) + 1, 2.0f) /
                       (nl * std::sqrt(facing * facing * (1 - alpha2) + alpha2) +
                        facing * std::sqrt(nl * nl * (1 - alpha2) + alpha2));
            });
        const Float3 mirror = normal * (2 * facing) - view;
        const LightCone cone = lobeCone(lobeTotal(roughness, facing), mirror, normal);
        squares += std::pow(difference(skyConeRadiance(kSky, cone), exact.radiance), 2);
        ++count;
    }
    std::printf("rms error of %d lobes %.4f\n", count, std::sqrt(squares / count));
    EXPECT_LT(std::sqrt(squares / count), 0.08);
}

TEST(SkyCone, isTheOverlapOfLobeAndVisibility)
{
    const auto visible = [](Float3 axis, float degrees)
    {
        VisibilityCone cone{};
        cone.axis = axis;
        cone.aperture = degrees * std::numbers::pi_v<float> / 180;
        cone.cos_aperture = std::cos(cone.aperture);
        cone.scale = 1;
        return cone;
    };
    const auto at = [](float degrees)
    {
        const float angle = degrees * std::numbers::pi_v<float> / 180;
        return Float3{std::cos(angle), std::sin(angle), 0};
    };
    const LightCone lobe{at(0), std::cos(std::numbers::pi_v<float> / 9)}; // 20 degrees
    const auto expect = [&](const VisibilityCone& cone, float middle, float half_angle)
    {
        const LightCone found = visibleLobeCone(lobe, cone);
        EXPECT_LT(length(found.axis - at(middle)), 1e-3f);
        EXPECT_NEAR(std::acos(found.cos_half_angle), half_angle * std::numbers::pi_v<float> / 180, 1e-3f);
    };
    expect(visible(at(30), 60), 0, 20); // all of the lobe
    expect(visible(at(50), 40), 15, 5); // from 10 to 20 degrees
    expect(visible(at(5), 10), 5, 10);  // all of the cone
    expect(visible(at(80), 40), 30, 0); // apart: between 20 and 40
}

} // namespace hearth::shared
