// Points and weights of Gauss-Legendre quadrature.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace hearth::specular
{

struct QuadraturePoint
{
    double at; ///< in (-1, 1), ascending
    double weight;
};

/// Compute the rule that is exact for polynomials of degree 2 count - 1 on [-1, 1].
/// count  1 or more
inline std::vector<QuadraturePoint> gaussLegendre(int count)
{
    std::vector<QuadraturePoint> points(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i)
    {
        // Tricomi's estimate of the root; Newton's method doubles its digits each time
        double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
        double slope = 1;
        for (int iteration = 0; iteration < 8; ++iteration)
        {
            double before = 0;
            double value = 1;
            for (int degree = 1; degree <= count; ++degree)
            {
                const double next = ((2 * degree - 1) * x * value - (degree - 1) * before) / degree;
                before = value;
                value = next;
            }
            slope = count * (x * value - before) / (x * x - 1);
            x -= value / slope;
        }
        points[static_cast<size_t>(i)] = {x, 2 / ((1 - x * x) * slope * slope)};
    }
    return points;
}

} // namespace hearth::specular
