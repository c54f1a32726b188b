// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/scale_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hearth
{

namespace
{

/// Diagonalise a symmetric matrix by cyclic Jacobi rotations; six sweeps reach double precision for 3 x 3.
std::array<double, 3> eigenvalues(double (&s)[3][3])
{
    constexpr int kSweeps = 6;
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q)
            {
                if (s[p][q] == 0.0)
                    continue;
                const double theta = (s[q][q] - s[p][p]) / (2.0 * s[p][q]);
                const double t =
                    (theta < 0 ? -1.0 : 1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
                const double c = 1.0 / std::sqrt(t * t + 1.0);
                const double sine = t * c;
                for (int k = 0; k < 3; ++k)
                {
                    const double a = s[k][p];
                    const double b = s[k][q];
                    s[k][p] = c * a - sine * b;
                    s[k][q] = sine * a + c * b;
                }
                for (int k = 0; k < 3; ++k)
                {
                    const double a = s[p][k];
                    const double b = s[q][k];
                    s[p][k] = c * a - sine * b;
                    s[q][k] = sine * a + c * b;
                }
            }
    return {s[0][0], s[1][1], s[2][2]};
}

} // namespace

float scaleBound(const Affine3& transform)
{
    double s[3][3] = {};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                s[i][j] += static_cast<double>(transform.m[k][i]) * static_cast<double>(transform.m[k][j]);
    const std::array<double, 3> squares = eigenvalues(s);
    const double largest = std::sqrt(std::max({squares[0], squares[1], squares[2], 0.0}));
    // the margin covers the rounding of the sums above and of the conversion
    const double bound = largest * (1.0 + 5e-7);
    return bound >= static_cast<double>(std::numeric_limits<float>::max()) ? std::numeric_limits<float>::max()
                                                                           : static_cast<float>(bound);
}

} // namespace hearth
