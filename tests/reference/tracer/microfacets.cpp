// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/microfacets.h"

#include <algorithm>

namespace hearth::reference
{

namespace
{

constexpr double kPi = 3.14159265358979323846;

} // namespace

Double3 visibleNormal(Double3 view, double alpha, double u, double v)
{
    const Double3 stretched = normalize({alpha * view.x, alpha * view.y, view.z});
    const double across = stretched.x * stretched.x + stretched.y * stretched.y;
    const Double3 t1 =
        across > 0 ? Double3{-stretched.y, stretched.x, 0} / std::sqrt(across) : Double3{1, 0, 0};
    const Double3 t2 = cross(stretched, t1);
    const double r = std::sqrt(u), phi = 2 * kPi * v, s = 0.5 * (1 + stretched.z);
    const double a = r * std::cos(phi);
    const double b = (1 - s) * std::sqrt(std::max(0.0, 1 - a * a)) + s * r * std::sin(phi);
    const Double3 n = t1 * a + t2 * b + stretched * std::sqrt(std::max(0.0, 1 - a * a - b * b));
    return normalize({alpha * n.x, alpha * n.y, std::max(1e-9, n.z)});
}

double maskingWeight(double nl, double nv, double alpha)
{
    const double a2 = alpha * alpha;
    const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1 + a2 * (1 / (c * c) - 1)) - 1); };
    return (1 + lambda(nv)) / (1 + lambda(nv) + lambda(nl));
}

double visibleDensity(double nh, double nv, double alpha)
{
    const double a2 = alpha * alpha;
    const double distribution = a2 / (kPi * std::pow(nh * nh * (a2 - 1) + 1, 2));
    // G1(view) D / (4 n.v)
    return distribution / (2 * (nv + std::sqrt(nv * nv * (1 - a2) + a2)));
}

} // namespace hearth::reference
