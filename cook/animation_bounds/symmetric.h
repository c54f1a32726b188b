// Eigenvectors of small symmetric matrices, and the operator norm.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/affine3d.h"

#include <array>

namespace hearth::animation_bounds
{

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// Eigenvalues and eigenvectors of a symmetric N x N matrix, by cyclic Jacobi rotations.
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

/// Return an upper bound for the largest singular value of the matrix, with a relative excess of at most
/// 1e-6.
double operatorNorm(const Matrix3& matrix);

/// Return the same bound for the linear part.
double operatorNorm(const Affine3d& transform);

} // namespace hearth::animation_bounds
