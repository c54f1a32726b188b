// Tests the table of sheen against integrals of the lobe over the directions of light.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/sheen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hearth::shared
{
namespace
{

/// Call visit(nl, nh, area) for directions of light over the hemisphere, by the angles to the normal and
/// about it; the heights are dense at the horizon.
template <typename Visit>
void visitLight(double nv, const Visit& visit)
{
    constexpr int kHeights = 1500, kTurns = 300;
    for (int i = 0; i < kHeights; ++i)
        for (int j = 0; j < kTurns; ++j)
        {
            const double u = (i + 0.5) / kHeights, nl = u * u * u;
            const double turn = std::numbers::pi * (j + 0.5) / kTurns;
            const double vl = nl * nv + std::sqrt((1 - nl * nl) * (1 - nv * nv)) * std::cos(turn);
            visit(nl, (nl + nv) / std::sqrt(2 + 2 * vl), 6 * std::numbers::pi * u * u / kHeights / kTurns);
        }
}

/// Share of constant light that white sheen reflects: Charlie's distribution, Neubelt's visibility.
double integrate(double roughness, double nv)
{
    const double alpha = roughness * roughness;
    double sum = 0;
    visitLight(nv,
               [&](double nl, double nh, double area)
               {
                   const double sine = std::sqrt(std::max(0.0, 1 - nh * nh));
                   const double distribution =
                       (2 + 1 / alpha) * std::pow(sine, 1 / alpha) / (2 * std::numbers::pi);
                   sum += distribution / (4 * (nl + nv - nl * nv)) * nl * area;
               });
    return sum;
}

constexpr double kRoughnesses[] = {0.07, 0.085, 0.13, 0.21, 0.34, 0.5, 0.68, 0.83, 1.0};
constexpr double kCosines[] = {1e-3, 0.004, 0.011, 0.03, 0.07, 0.15, 0.3, 0.45, 0.62, 0.8, 0.95, 1.0};

} // namespace

TEST(Sheen, isWithinFiveThousandthsOfTheIntegral)
{
    double largest = 0;
    for (const double roughness : kRoughnesses)
        for (const double cosine : kCosines)
        {
            const double exact = integrate(roughness, cosine);
            const double found =
                double{sheenTotal(static_cast<float>(roughness), static_cast<float>(cosine)).albedo};
            // above 1 the albedo only limits the lobe
            const double error = (found - exact) / std::max(exact, 1.0);
            EXPECT_NEAR(error, 0, 0.005) << roughness << ' ' << cosine << ' ' << exact;
            largest = std::max(largest, std::abs(error));
        }
    std::printf("largest error of the albedo of white sheen: %.4f\n", largest);
}

/// At roughness 1 and normal incidence the lobe is 3 sin(t / 2) / (8 pi) at an angle t to the normal.
TEST(Sheen, isTheClosedFormOfRoughSheenSeenFromAbove)
{
    const double s = std::sqrt(0.5);
    EXPECT_NEAR(double{sheenTotal(1, 1).albedo}, 3 * (std::pow(s, 3) / 3 - 2 * std::pow(s, 5) / 5), 0.0005);
}

/// Smooth sheen is as rough as the first row.
TEST(Sheen, hasAFirstRoughness)
{
    EXPECT_EQ(sheenTotal(0, 0.1f).albedo, sheenTotal(kMinSheenRoughness, 0.1f).albedo);
    EXPECT_LT(integrate(0.03, 0.2), 0.001) << "nothing is lost but at the horizon";
}

TEST(Sheen, neverReflectsMoreThanArrives)
{
    double most = 0;
    for (const double roughness : kRoughnesses)
        for (const double cosine : kCosines)
        {
            const SheenTotal total = sheenTotal(static_cast<float>(roughness), static_cast<float>(cosine));
            double lobe = 0;
            visitLight(cosine,
                       [&](double nl, double nh, double area)
                       {
                           lobe += double{sheenLobe(static_cast<float>(roughness), static_cast<float>(nh),
                                                    static_cast<float>(nl), static_cast<float>(cosine))} *
                                   nl * area;
                       });
            lobe *= double{sheenLimit(total)};
            most = std::max(most, lobe);
            EXPECT_NEAR(lobe, double{std::min(total.albedo, 1.0f)}, 0.006) << roughness << ' ' << cosine;
            // a white surface below white sheen reflects all light, a dark one less
            EXPECT_NEAR(lobe + double{belowSheen({1, 1, 1}, total)}, 1, 0.006);
            EXPECT_NEAR(double{belowSheen({0.1f, 0.5f, 0.3f}, total)},
                        1 - 0.5 * double{std::min(total.albedo, 1.0f)}, 1e-6);
        }
    EXPECT_GT(most, 0.99) << "at grazing angles all of it";
}

/// Sheen is retroreflective: the mean direction leans to the view.
TEST(Sheen, getsItsLightFromTheSideOfTheView)
{
    for (const float roughness : {0.1f, 0.4f, 1.0f})
        for (const double cosine : {0.1, 0.4, 0.8, 1.0})
        {
            double across = 0, up = 0;
            constexpr int kHeights = 400, kTurns = 400;
            const double level = std::sqrt(1 - cosine * cosine);
            for (int i = 0; i < kHeights; ++i)
                for (int j = 0; j < kTurns; ++j)
                {
                    const double nl = (i + 0.5) / kHeights, turn = std::numbers::pi * (j + 0.5) / kTurns;
                    const double x = std::sqrt(1 - nl * nl) * std::cos(turn);
                    const double nh = (nl + cosine) / std::sqrt(2 + 2 * (nl * cosine + x * level));
                    const double weight =
                        double{sheenLobe(roughness, static_cast<float>(nh), static_cast<float>(nl),
                                         static_cast<float>(cosine))} *
                        nl;
                    across += weight * x;
                    up += weight * nl;
                }
            const SheenTotal total = sheenTotal(roughness, static_cast<float>(cosine));
            const Float3 view{static_cast<float>(level), 0, static_cast<float>(cosine)};
            const Float3 axis = sheenCone(total, view, {0, 0, 1}).axis;
            EXPECT_NEAR(length(axis), 1, 1e-3f);
            EXPECT_NEAR(double{std::atan2(axis.x, axis.z)}, std::atan2(across, up), 0.03)
                << roughness << ' ' << cosine;
        }
}

} // namespace hearth::shared
