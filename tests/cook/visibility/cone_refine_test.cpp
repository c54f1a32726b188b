// Tests visibility cones refined by nine spherical harmonics.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/cone_refine.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <tbb/global_control.h>

namespace hearth::visibility
{

namespace
{

constexpr double kPi = std::numbers::pi;

/// Integrate over all directions by midpoints of cells of equal area.
Sh9 project(const std::function<double(Double3)>& visibility)
{
    constexpr int kRows = 200, kColumns = 200;
    Sh9 sum{};
    for (int i = 0; i < kRows; ++i)
        for (int j = 0; j < kColumns; ++j)
        {
            const double z = -1 + (2 * i + 1.0) / kRows, phi = (j + 0.5) / kColumns * 2 * kPi;
            const double r = std::sqrt(1 - z * z);
            const Double3 w{r * std::cos(phi), r * std::sin(phi), z};
            const double v = visibility(w) * 4 * kPi / (kRows * kColumns);
            const Sh9 basis = sphericalHarmonics(w);
            for (size_t k = 0; k < 9; ++k)
                sum[k] += v * basis[k];
        }
    return sum;
}

Double3 unit(Double3 v)
{
    return v * (1 / length(v));
}

/// Closed form by moments, which are the first four harmonics; the aperture is at most a right angle.
ConeFit closedForm(const Sh9& sh)
{
    const double m0 = sh[0] * std::sqrt(4 * kPi), band1 = std::sqrt(4 * kPi / 3);
    const Double3 m1{sh[3] * band1, sh[1] * band1, sh[2] * band1};
    const double rho = length(m1) / m0;
    if (rho < 0.5)
        return {unit(m1), kPi / 2, std::min(1.0, length(m1) / kPi)};
    return {unit(m1), std::acos(2 * rho - 1), std::min(1.0, m0 / (4 * kPi * (1 - rho)))};
}

double distance(const Sh9& a, const Sh9& b)
{
    double sum = 0;
    for (size_t k = 0; k < 9; ++k)
        sum += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(sum);
}

} // namespace

TEST(SphericalHarmonics, areOrthonormal)
{
    for (size_t k = 0; k < 9; ++k)
    {
        const Sh9 row = project([&](Double3 w) { return sphericalHarmonics(w)[k]; });
        for (size_t j = 0; j < 9; ++j)
            EXPECT_NEAR(row[j], j == k ? 1 : 0, 1e-3);
    }
}

TEST(HarmonicsOf, areTheIntegralsOfTheCone)
{
    for (const ConeFit& cone : {ConeFit{{0, 0, 1}, 0.6, 1}, ConeFit{unit({1, -2, 0.5}), 1.2, 0.7},
                                ConeFit{unit({-1, 0.3, -0.2}), kPi / 2, 0.4}})
    {
        const Sh9 expected = project(
            [&](Double3 w) { return dot(w, cone.axis) > std::cos(cone.aperture_rad) ? cone.scale : 0; });
        EXPECT_LT(distance(computeHarmonics(cone), expected), 0.02);
    }
}

TEST(RefineCone, findsConesAgainFromAnywhereNear)
{
    std::mt19937 random(2);
    const auto number = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
    for (int i = 0; i < 50; ++i)
    {
        const Double3 axis = unit({number() - 0.5, number() - 0.5, number() - 0.5});
        const ConeFit truth{axis, 0.3 + number() * 1.2, 0.3 + number() * 0.7};
        const Double3 beside = unit(axis + Double3{0.4 * number(), -0.4 * number(), 0.4 * number()});
        const RefinedCone found = refineCone(computeHarmonics(truth), {beside, 1, 0.5}, beside);
        EXPECT_LT(found.distance2, 1e-8);
        EXPECT_GT(dot(found.cone.axis, axis), 1 - 1e-5);
        EXPECT_NEAR(found.cone.aperture_rad, truth.aperture_rad, 1e-2);
    }
}

TEST(RefineCone, staysWithinItsBoundsAndNeverGetsWorse)
{
    std::mt19937 random(3);
    const auto number = [&] { return static_cast<double>(random() >> 8) * 0x1p-23 - 1; };
    for (int i = 0; i < 50; ++i)
    {
        Sh9 sh;
        for (double& x : sh)
            x = number() * 3;
        const Double3 normal = unit({number(), number(), number()});
        const RefinedCone found = refineCone(sh, {unit({number(), number(), number()}), 0.8, 0.9}, normal);
        EXPECT_LE(found.distance2, found.start_distance2);
        EXPECT_NEAR(length(found.cone.axis), 1, 1e-9);
        EXPECT_GT(found.cone.aperture_rad, 0);
        EXPECT_LE(found.cone.aperture_rad, kPi / 2);
        EXPECT_GE(found.cone.scale, 0);
        EXPECT_LE(found.cone.scale, 1);
    }
}

TEST(RefineCone, takesTheBetterOfTwoOpenings)
{
    // one opening about the normal and a smaller one far from it: a search that starts in the small one stays
    // there
    const Double3 normal{0, 0, 1}, aside = unit({1, 0, 0.1});
    Sh9 both = computeHarmonics({normal, 0.5, 1});
    const Sh9 small = computeHarmonics({aside, 0.25, 1});
    for (size_t k = 0; k < 9; ++k)
        both[k] += small[k];
    const RefinedCone one = refineCone(both, {aside, 0.25, 1}, aside),
                      two = refineCone(both, {aside, 0.25, 1}, normal);
    EXPECT_LE(two.distance2, one.distance2 * (1 + 1e-6));
    EXPECT_GT(dot(two.cone.axis, normal), 0.9);
}

TEST(RefineCones, gainLittleOverTheClosedForm)
{
    // a half-space above each point with random occluding balls in front of it, as a vertex of a real model
    // has
    std::mt19937 random(8);
    const auto number = [&] { return static_cast<double>(random() >> 8) * 0x1p-23 - 1; };
    std::vector<Sh9> visibility;
    std::vector<ConeFit> starts;
    std::vector<Float3> normals;
    for (int i = 0; i < 40; ++i)
    {
        std::vector<ConeFit> blockers;
        for (int b = 0; b < 3; ++b)
            blockers.push_back(
                {unit({number(), number(), std::abs(number())}), 0.3 + 0.3 * std::abs(number()), 1});
        visibility.push_back(project(
            [&](Double3 w)
            {
                for (const ConeFit& blocker : blockers)
                    if (dot(w, blocker.axis) > std::cos(blocker.aperture_rad))
                        return 0;
                return w.z > 0 ? 1 : 0;
            }));
        starts.push_back(closedForm(visibility.back()));
        normals.push_back({0, 0, 1});
    }
    const RefinedCones refined = refineCones(visibility, starts, normals);
    EXPECT_LE(refined.statistics.rms, refined.statistics.start_rms);
    EXPECT_GT(refined.statistics.rms, 0.1 * refined.statistics.start_rms)
        << "then the closed form would be a bad one after all";
    std::printf("distance to the harmonics: %.4f closed form, %.4f refined\n", refined.statistics.start_rms,
                refined.statistics.rms);

    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
    const RefinedCones again = refineCones(visibility, starts, normals);
    EXPECT_EQ(std::memcmp(again.cones.data(), refined.cones.data(), again.cones.size() * sizeof(ConeFit)), 0);
}

} // namespace hearth::visibility
