// Small matrices: eigenvectors of symmetric ones, and the operator norm.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/affine3d.h"

#include <array>

namespace hearth::motion
{

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// Of a symmetric N x N matrix, by cyclic Jacobi rotations.
template <size_t N>
struct Eigenvectors
{
    std::array<double, N> values;                 ///< largest first
    std::array<std::array<double, N>, N> vectors; ///< vectors[i] belongs to values[i]; orthonormal
};

template <size_t N>
Eigenvectors<N> eigenvectors(std::array<std::array<double, N>, N> symmetric);

extern template Eigenvectors<3> eigenvectors(std::array<std::array<double, 3>, 3>);
extern template Eigenvectors<4> eigenvectors(std::array<std::array<double, 4>, 4>);

/// At least the largest singular value of the matrix, and at most 1e-6 of it more.
double operatorNorm(const Matrix3& matrix);

/// The same for the linear part.
double operatorNorm(const Affine3d& transform);

} // namespace hearth::motion
