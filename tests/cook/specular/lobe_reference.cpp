// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/specular/lobe_reference.h"

#include <algorithm>
#include <numbers>

namespace hearth::test
{

using specular::Cone;
using specular::Lobe;
using specular::Masking;

namespace
{

double computeLambda(double cosine, double alpha)
{
    return (std::sqrt(1 + alpha * alpha * (1 / (cosine * cosine) - 1)) - 1) / 2;
}

/// G2 / G1(view).
double shadowing(double view_cosine, double light_cosine, double alpha, Masking masking)
{
    const double light = computeLambda(light_cosine, alpha);
    if (masking == Masking::separable)
        return 1 / (1 + light);
    const double view = computeLambda(view_cosine, alpha);
    return (1 + view) / (1 + view + light);
}

Double3 unit(const Double3& v)
{
    return v * (1 / length(v));
}

} // namespace

double countedOcclusion(const Lobe& lobe, const Cone& cone, int side)
{
    const double alpha = lobe.roughness * lobe.roughness;
    const Double3 view{-std::sin(lobe.theta_o), 0, std::cos(lobe.theta_o)};
    const Double3 stretched = unit({alpha * view.x, alpha * view.y, view.z});
    const double across = std::hypot(stretched.x, stretched.y);
    const Double3 first =
        across > 0 ? Double3{-stretched.y / across, stretched.x / across, 0} : Double3{1, 0, 0};
    const Double3 second = cross(stretched, first);
    double inside = 0;
    double all = 0;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
        {
            const double radius = std::sqrt((i + 0.5) / side);
            const double angle = 2 * std::numbers::pi * (j + 0.5) / side;
            const double a = radius * std::cos(angle);
            const double lift = (1 + stretched.z) / 2;
            const double b = (1 - lift) * std::sqrt(1 - a * a) + lift * radius * std::sin(angle);
            const Double3 normal =
                first * a + second * b + stretched * std::sqrt(std::max(0.0, 1 - a * a - b * b));
            const Double3 half = unit({alpha * normal.x, alpha * normal.y, std::max(0.0, normal.z)});
            const Double3 light = half * (2 * dot(view, half)) - view;
            if (light.z <= 0)
                continue;
            const double weight = shadowing(view.z, light.z, alpha, lobe.masking);
            all += weight;
            if (dot(light, cone.axis) >= std::cos(cone.half_angle))
                inside += weight;
        }
    return inside / all;
}

double integratedOcclusion(const Lobe& lobe, const Cone& cone, int steps)
{
    const double alpha2 = std::pow(lobe.roughness, 4);
    const Double3 view{-std::sin(lobe.theta_o), 0, std::cos(lobe.theta_o)};
    const Double3 other = std::abs(cone.axis.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0};
    const Double3 first = unit(cross(cone.axis, other));
    const Double3 second = cross(cone.axis, first);
    // over [from, to] of the angle to the axis
    const auto integrate = [&](double from, double to)
    {
        double sum = 0;
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < 2 * steps; ++j)
            {
                const double angle = from + (to - from) * (i + 0.5) / steps;
                const double around = std::numbers::pi * (j + 0.5) / steps;
                const Double3 light =
                    cone.axis * std::cos(angle) +
                    (first * std::cos(around) + second * std::sin(around)) * std::sin(angle);
                if (light.z <= 0)
                    continue;
                const double cosine = unit(light + view).z;
                const double base = cosine * cosine * (alpha2 - 1) + 1;
                sum += std::sin(angle) * (to - from) / (base * base) *
                       shadowing(view.z, light.z, std::sqrt(alpha2), lobe.masking);
            }
        return sum;
    };
    const double inside = integrate(0, cone.half_angle);
    return inside / (inside + integrate(cone.half_angle, std::numbers::pi));
}

} // namespace hearth::test
