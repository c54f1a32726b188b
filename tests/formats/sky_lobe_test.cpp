// The parts in which a lobe is looked up in the image of a sky, beside the lobe of GGX.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/double3.h"
#include "formats/gpu_shared/sky.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace hearth::shared
{

namespace
{

constexpr double kPi = std::numbers::pi;
constexpr int kRings = 48, kTurns = 96;
constexpr int kDegree = 12;

/// Directions that share the sphere, with their solid angles. The normal is +Z.
struct Sphere
{
    std::vector<Double3> directions;
    std::vector<double> solid_angles;

    Sphere()
    {
        for (int ring = 0; ring < kRings; ++ring)
            for (int turn = 0; turn < kTurns; ++turn)
            {
                const double height = 1 - 2 * (ring + 0.5) / kRings, angle = 2 * kPi * (turn + 0.5) / kTurns;
                const double across = std::sqrt(1 - height * height);
                directions.push_back({across * std::cos(angle), across * std::sin(angle), height});
                solid_angles.push_back(4 * kPi / (kRings * kTurns));
            }
    }
};

const Sphere& sphere()
{
    static const Sphere made;
    return made;
}

/// Weights of directions, times their solid angles, with the sum 1.
using Weights = std::vector<double>;

Weights weigh(const std::function<double(Double3)>& weight)
{
    Weights weights;
    double sum = 0;
    for (size_t i = 0; i < sphere().directions.size(); ++i)
    {
        weights.push_back(weight(sphere().directions[i]) * sphere().solid_angles[i]);
        sum += weights.back();
    }
    for (double& value : weights)
        value /= sum;
    return weights;
}

/// GGX with height-correlated masking (glTF 2.0, appendix B), times the cosine.
Weights weighLobe(double roughness, double n_dot_v)
{
    const double a2 = std::pow(roughness, 4);
    const Double3 view{std::sqrt(1 - n_dot_v * n_dot_v), 0, n_dot_v};
    return weigh(
        [&](Double3 light)
        {
            if (light.z <= 0)
                return 0.0;
            const Double3 sum = light + view;
            const double cosine = sum.z / length(sum);
            const double d = a2 / std::pow(cosine * cosine * (a2 - 1) + 1, 2);
            const double masking = light.z * std::sqrt(n_dot_v * n_dot_v * (1 - a2) + a2) +
                                   n_dot_v * std::sqrt(light.z * light.z * (1 - a2) + a2);
            return d * light.z / masking;
        });
}

/// Weights of a mip of a probe (formats/records/probe.h).
Weights weighMip(double roughness, Double3 axis)
{
    const double a2 = std::pow(roughness, 4);
    return weigh(
        [&](Double3 light)
        {
            const double cosine = dot(light, axis) / length(axis);
            return std::max(cosine, 0.0) * a2 / std::pow((1 + cosine) / 2 * (a2 - 1) + 1, 2);
        });
}

/// Size of weights as harmonics of degree 1 to kDegree, those of degree l weighted by 1 / (1 + l^2): by the
/// addition theorem a sum over pairs of directions.
double measure(const Weights& weights)
{
    constexpr int kSteps = 4096;
    static const std::vector<double> kernel = []
    {
        std::vector<double> values;
        for (int step = 0; step <= kSteps; ++step)
        {
            const double t = 2.0 * step / kSteps - 1;
            double before = 1, now = t, sum = 0;
            for (int l = 1; l <= kDegree; ++l)
            {
                sum += (2 * l + 1) / (4 * kPi) * now / (1 + l * l);
                const double next = ((2 * l + 1) * t * now - l * before) / (l + 1);
                before = now;
                now = next;
            }
            values.push_back(sum);
        }
        return values;
    }();
    double sum = 0;
    for (size_t i = 0; i < weights.size(); ++i)
        if (weights[i] != 0)
            for (size_t j = 0; j < weights.size(); ++j)
            {
                const double cosine = dot(sphere().directions[i], sphere().directions[j]);
                sum += weights[i] * weights[j] * kernel[static_cast<size_t>((cosine + 1) / 2 * kSteps + 0.5)];
            }
    return std::sqrt(std::max(sum, 0.0));
}

Weights subtract(Weights a, const Weights& b, double share)
{
    for (size_t i = 0; i < a.size(); ++i)
        a[i] -= share * b[i];
    return a;
}

TEST(SkyLobe, isNearTheLobeOfGgx)
{
    const Weights cosine = weigh([](Double3 d) { return std::max(d.z, 0.0); });
    const Weights even = weigh([](Double3) { return 1.0; });
    for (const double roughness : {0.4, 0.65, 0.8})
        for (const double n_dot_v : {0.1, 0.5, 1.0})
        {
            const Weights exact = weighLobe(roughness, n_dot_v);
            const SkyLobe lobe = skyLobe(static_cast<float>(roughness), static_cast<float>(n_dot_v));
            const Double3 mirror{-std::sqrt(1 - n_dot_v * n_dot_v), 0, n_dot_v}, normal{0, 0, 1};
            const double turn = double{lobe.turn}, wide = double{lobe.wide}, flat = double{lobe.even};
            Weights rest = subtract(
                exact, weighMip(double{lobe.roughness}, mirror * (1 - turn) + normal * turn), 1 - wide);
            rest = subtract(std::move(rest), cosine, wide * (1 - flat));
            rest = subtract(std::move(rest), even, wide * flat);
            // one mip about the mean direction of the lobe
            Double3 mean{};
            for (size_t i = 0; i < exact.size(); ++i)
                mean = mean + sphere().directions[i] * exact[i];
            const double size = measure(exact), error = measure(rest) / size;
            const double one = measure(subtract(exact, weighMip(roughness, mean), 1)) / size;
            const double aside = roughness < 0.5 ? 0.2 : 0.11; // a narrow lobe seen from aside is long
            EXPECT_LT(error, 0.05 + aside * (1 - n_dot_v)) << roughness << " " << n_dot_v;
            EXPECT_LT(error, 0.7 * one) << roughness << " " << n_dot_v;
        }
}

TEST(SkyLobe, isTheMirrorOfASmoothSurface)
{
    for (const float n_dot_v : {0.1f, 1.0f})
    {
        const SkyLobe lobe = skyLobe(0.02f, n_dot_v);
        EXPECT_LT(lobe.turn, 1e-3f);
        EXPECT_LT(lobe.wide, 1e-3f);
        EXPECT_LE(lobe.roughness, 0.02f);
    }
    for (const float roughness : {0.0f, 0.3f, 1.0f})
        for (const float n_dot_v : {0.0f, 0.3f, 1.0f})
        {
            const SkyLobe lobe = skyLobe(roughness, n_dot_v);
            EXPECT_GE(lobe.wide, 0);
            EXPECT_LE(lobe.wide, 1);
            EXPECT_LE(lobe.even, 1);
            EXPECT_GE(lobe.roughness, 0);
        }
}

} // namespace

} // namespace hearth::shared
