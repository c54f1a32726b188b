// Tests the table of specular reflectance against integrals of the BRDF over the directions of light.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/reflectance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace hearth::shared
{
namespace
{

struct Sums
{
    double scale = 0, bias = 0;
};

/// Midpoints and widths of [0, end], dense about `peak` by the fourth power.
struct Step
{
    double at, width;
};
std::vector<Step> denseAbout(double peak, double end, int steps)
{
    std::vector<Step> found;
    const auto add = [&](double from, double to)
    {
        for (int i = 0; i < steps; ++i)
        {
            const double low = std::pow(double{1} * i / steps, 4), high = std::pow((i + 1.0) / steps, 4);
            found.push_back({from + (to - from) * (low + high) / 2, std::abs(to - from) * (high - low)});
        }
    };
    if (peak > 0)
        add(peak, 0);
    if (peak < end)
        add(peak, end);
    return found;
}

/// Integrate GGX with height-correlated Smith masking and Schlick's Fresnel term over light above the
/// horizon, by the angles to the normal and about it.
Sums integrate(double roughness, double cosine)
{
    const double pi = std::numbers::pi, alpha2 = std::pow(roughness, 4);
    const double sine = std::sqrt(1 - cosine * cosine);
    const std::vector<Step> turns = denseAbout(0, pi, 300); // from the mirror direction; both sides are alike
    Sums sums;
    for (const Step& tilt : denseAbout(std::acos(cosine), pi / 2, 400))
        for (const Step& turn : turns)
        {
            const double across = std::sin(tilt.at), nl = std::cos(tilt.at);
            // view (-sine, 0, cosine)
            const double x = across * std::cos(turn.at) - sine, y = across * std::sin(turn.at),
                         z = nl + cosine;
            const double size = std::sqrt(x * x + y * y + z * z);
            const double nh = z / size, vh = (z * cosine - x * sine) / size;
            const double lobe =
                alpha2 / (pi * std::pow((x * x + y * y) / (size * size) + nh * nh * alpha2, 2));
            const double masked = 0.5 / (nl * std::sqrt(cosine * cosine * (1 - alpha2) + alpha2) +
                                         cosine * std::sqrt(nl * nl * (1 - alpha2) + alpha2));
            const double light = lobe * masked * nl * across * tilt.width * 2 * turn.width;
            const double fresnel = std::pow(1 - std::min(vh, 1.0), 5);
            sums.scale += light * (1 - fresnel);
            sums.bias += light * fresnel;
        }
    return sums;
}

} // namespace

TEST(Reflectance, isWithinFiveThousandthsOfTheIntegral)
{
    double largest = 0;
    for (const double roughness :
         {0.0, 0.05, 0.0625, 0.08, 0.11, 0.17, 0.24, 0.3, 0.41, 0.5, 0.63, 0.77, 0.9, 1.0})
        for (const double cosine :
             {1e-4, 0.001, 0.004, 0.011, 0.03, 0.07, 0.15, 0.3, 0.45, 0.62, 0.8, 0.95, 1.0})
        {
            // shading draws roughness 0 as 0.045
            const Sums exact = integrate(std::max(roughness, 0.045), cosine);
            const LobeTotal found = lobeTotal(static_cast<float>(roughness), static_cast<float>(cosine));
            const double both = double{found.scale + found.bias};
            EXPECT_NEAR(double{found.scale}, exact.scale, 0.005) << roughness << ' ' << cosine;
            EXPECT_NEAR(double{found.bias}, exact.bias, 0.005) << roughness << ' ' << cosine;
            EXPECT_NEAR(both, exact.scale + exact.bias, 0.005) << roughness << ' ' << cosine;
            largest = std::max(largest, std::abs(both - exact.scale - exact.bias));
        }
    std::printf("largest error of the reflectance of a white metal: %.4f\n", largest);
}

/// At roughness 1 and normal incidence the lobe is 1 / (2 pi (1 + n.l)).
TEST(Reflectance, isTheClosedFormOfARoughMetalSeenFromAbove)
{
    const LobeTotal found = lobeTotal(1, 1);
    EXPECT_NEAR(found.scale + found.bias, 1 - std::log(2.0f), 0.0005f);
}

TEST(Reflectance, leavesNothingOfAWhiteSurface)
{
    const DielectricReflectance dielectrics[] = {defaultDielectric(),
                                                 specularDielectric({0.3f, 0.3f, 0.3f}, 1),
                                                 specularDielectric({2, 2, 2}, 1),
                                                 specularDielectric({0.04f, 0.04f, 0.04f}, 0.4f),
                                                 specularDielectric({0, 0, 0}, 1),
                                                 specularDielectric({0.04f, 0.04f, 0.04f}, 0)};
    for (const DielectricReflectance& dielectric : dielectrics)
        for (const float roughness : {0.0f, 0.1f, 0.4f, 0.7f, 1.0f})
            for (const float cosine : {0.01f, 0.2f, 0.6f, 1.0f})
                for (const float metallic : {0.0f, 0.3f, 1.0f})
                {
                    const SurfaceAlbedo found =
                        surfaceAlbedo({1, 1, 1}, metallic, dielectric, lobeTotal(roughness, cosine));
                    EXPECT_NEAR(found.diffuse.y + found.specular.y, 1, 1e-6f);
                }
}

/// The brightest channel of a coloured reflectance says what is left for the diffuse part.
TEST(Reflectance, neverExceedsArrivingLight)
{
    const DielectricReflectance dielectric = specularDielectric({0.9f, 0.2f, 0.05f}, 1);
    for (const float roughness : {0.1f, 0.5f, 1.0f})
        for (const float cosine : {0.02f, 0.5f, 1.0f})
        {
            const SurfaceAlbedo found = surfaceAlbedo({1, 1, 1}, 0, dielectric, lobeTotal(roughness, cosine));
            EXPECT_NEAR(found.diffuse.x + found.specular.x, 1, 1e-6f);
            EXPECT_EQ(found.diffuse.x, found.diffuse.z);
            EXPECT_LT(found.diffuse.z + found.specular.z, 1);
        }
}

/// The bihemispherical reflectance is the mean of the directional one, weighted by the cosine. Here from
/// integrals over light and views.
TEST(Reflectance, reflectsToAllSidesTheMeanOverViews)
{
    for (const double roughness : {0.2, 0.5, 0.95})
    {
        // Gauss-Legendre nodes of the squared cosine
        constexpr double kNodes[] = {0.0469100770, 0.2307653449, 0.5, 0.7692346551, 0.9530899230};
        constexpr double kWeights[] = {0.1184634425, 0.2393143352, 0.2844444444, 0.2393143352, 0.1184634425};
        double soil = 0, brass = 0;
        for (size_t i = 0; i < std::size(kNodes); ++i)
        {
            const Sums lobe = integrate(roughness, std::sqrt(kNodes[i]));
            const double white = lobe.scale + lobe.bias;
            const auto reflected = [&](double f0)
            { return (f0 * lobe.scale + lobe.bias) * (1 + f0 * (1 / white - 1)); };
            soil += kWeights[i] * (reflected(0.04) + 0.2 * (1 - reflected(0.04)));
            brass += kWeights[i] * reflected(0.35);
        }
        const auto rough = static_cast<float>(roughness);
        EXPECT_NEAR(double{bihemisphericalReflectance({0.2f, 0, 0}, 0, defaultDielectric(), rough).x}, soil,
                    0.004)
            << roughness;
        EXPECT_NEAR(double{bihemisphericalReflectance({0.35f, 0, 0}, 1, defaultDielectric(), rough).x}, brass,
                    0.004)
            << roughness;
    }
}

/// F90 is the reflectance of grazing light: the whole term of Schlick scales with the strength.
TEST(Reflectance, scalesWithTheStrengthOfADielectric)
{
    const LobeTotal lobe = lobeTotal(0.3f, 0.2f);
    const DielectricReflectance half = specularDielectric({0.08f, 0.08f, 0.08f}, 0.5f);
    const SurfaceAlbedo found = surfaceAlbedo({0, 0, 0}, 0, half, lobe);
    const float once = 0.5f * (0.08f * lobe.scale + lobe.bias);
    EXPECT_NEAR(found.specular.x, once * (1 + 0.04f * (1 / (lobe.scale + lobe.bias) - 1)), 1e-6f);
    EXPECT_NEAR(found.f0.x, 0.04f, 1e-6f);
    EXPECT_NEAR(found.f90, 0.5f, 1e-6f);
}

/// Along the normal a smooth surface reflects F0, which may be 0.
TEST(Reflectance, isFiniteForBlackMirrors)
{
    const SurfaceAlbedo metal = surfaceAlbedo({0, 0, 0}, 1, defaultDielectric(), lobeTotal(0, 1));
    EXPECT_EQ(metal.specular, (Float3{0, 0, 0}));
    EXPECT_TRUE(std::isfinite(metal.scattering.x));
    const SurfaceAlbedo vacuum =
        surfaceAlbedo({0, 0, 0}, 0, specularDielectric({0, 0, 0}, 1), lobeTotal(0, 1));
    EXPECT_TRUE(std::isfinite(vacuum.scattering.x));
}

} // namespace hearth::shared
