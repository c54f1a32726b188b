// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_bounds/symmetric.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace hearth::animation_bounds
{

namespace
{

// Number of Jacobi sweeps: enough for double precision at this size.
constexpr int kSweeps = 10;

/// Rotate rows and columns p and q so that s[p][q] becomes 0, and the rows of `vectors` with them.
template <size_t N>
void rotate(std::array<std::array<double, N>, N>& s, std::array<std::array<double, N>, N>& vectors, size_t p,
            size_t q)
{
    if (s[p][q] == 0)
        return;
    const double theta = (s[q][q] - s[p][p]) / (2 * s[p][q]);
    const double t = (theta < 0 ? -1.0 : 1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1));
    const double cosine = 1 / std::sqrt(t * t + 1);
    const double sine = t * cosine;
    for (size_t k = 0; k < N; ++k)
    {
        const double a = s[k][p], b = s[k][q];
        s[k][p] = cosine * a - sine * b;
        s[k][q] = sine * a + cosine * b;
    }
    for (size_t k = 0; k < N; ++k)
    {
        const double a = s[p][k], b = s[q][k];
        s[p][k] = cosine * a - sine * b;
        s[q][k] = sine * a + cosine * b;
        const double v = vectors[p][k], w = vectors[q][k];
        vectors[p][k] = cosine * v - sine * w;
        vectors[q][k] = sine * v + cosine * w;
    }
}

/// Return the largest eigenvalue of a positive semidefinite matrix.
/// source  O. K. Smith, "Eigenvalues of a symmetric 3 x 3 matrix", 1961
double largestEigenvalue(const Matrix3& s)
{
    const double mean = (s[0][0] + s[1][1] + s[2][2]) / 3;
    const double off = s[0][1] * s[0][1] + s[0][2] * s[0][2] + s[1][2] * s[1][2];
    const double a = s[0][0] - mean, b = s[1][1] - mean, c = s[2][2] - mean;
    const double p = std::sqrt((a * a + b * b + c * c + 2 * off) / 6);
    if (!(p > 0))
        return mean;
    const double det = a * (b * c - s[1][2] * s[1][2]) - s[0][1] * (s[0][1] * c - s[1][2] * s[0][2]) +
                       s[0][2] * (s[0][1] * s[1][2] - b * s[0][2]);
    const double r = std::clamp(det / (2 * p * p * p), -1.0, 1.0);
    return mean + 2 * p * std::cos(std::acos(r) / 3);
}

} // namespace

template <size_t N>
Eigenvectors<N> eigenvectors(std::array<std::array<double, N>, N> symmetric)
{
    std::array<std::array<double, N>, N> vectors{};
    for (size_t i = 0; i < N; ++i)
        vectors[i][i] = 1;
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (size_t p = 0; p + 1 < N; ++p)
            for (size_t q = p + 1; q < N; ++q)
                rotate(symmetric, vectors, p, q);
    std::array<size_t, N> order;
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return symmetric[a][a] > symmetric[b][b]; });
    Eigenvectors<N> result;
    for (size_t i = 0; i < N; ++i)
    {
        result.values[i] = symmetric[order[i]][order[i]];
        result.vectors[i] = vectors[order[i]];
    }
    return result;
}

template Eigenvectors<3> eigenvectors(std::array<std::array<double, 3>, 3>);
template Eigenvectors<4> eigenvectors(std::array<std::array<double, 4>, 4>);

double operatorNorm(const Matrix3& m)
{
    Matrix3 square;
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
            square[i][j] = m[0][i] * m[0][j] + m[1][i] * m[1][j] + m[2][i] * m[2][j];
    // the margin covers the rounding of the products and of the angle
    return std::sqrt(std::max(0.0, largestEigenvalue(square))) * (1 + 5e-7);
}

double operatorNorm(const Affine3d& t)
{
    return operatorNorm(Matrix3{{{t.m[0][0], t.m[0][1], t.m[0][2]},
                                 {t.m[1][0], t.m[1][1], t.m[1][2]},
                                 {t.m[2][0], t.m[2][1], t.m[2][2]}}});
}

} // namespace hearth::animation_bounds
