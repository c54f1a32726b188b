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
    for (const float roughness : {0.1f, 0.4f, 0.7f, 1.0f})
        for (const float cosine : {0.01f, 0.2f, 0.6f, 1.0f})
            for (const float metallic : {0.0f, 0.3f, 1.0f})
            {
                const SurfaceAlbedo found = surfaceAlbedo({1, 1, 1}, metallic, lobeTotal(roughness, cosine));
                EXPECT_NEAR(found.diffuse.y + found.specular.y, 1, 1e-6f);
            }
}

} // namespace hearth::shared
