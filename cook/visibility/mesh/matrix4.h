// Small symmetric matrices, of least squares with four unknowns.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstddef>

namespace hearth::visibility
{

using Vector4 = std::array<double, 4>;
using Matrix4 = std::array<Vector4, 4>;

/// Add weight v v^T.
inline void addProduct(Matrix4& m, const Vector4& v, double weight)
{
    for (size_t i = 0; i < 4; ++i)
        for (size_t j = 0; j < 4; ++j)
            m[i][j] += weight * v[i] * v[j];
}

/// Invert a symmetric, positive definite matrix, by Gauss and Jordan.
inline Matrix4 inverse(Matrix4 m)
{
    for (size_t k = 0; k < 4; ++k)
    {
        const double pivot = 1 / m[k][k];
        m[k][k] = 1;
        for (double& value : m[k])
            value *= pivot;
        for (size_t row = 0; row < 4; ++row)
        {
            if (row == k)
                continue;
            const double factor = m[row][k];
            m[row][k] = 0;
            for (size_t column = 0; column < 4; ++column)
                m[row][column] -= factor * m[k][column];
        }
    }
    return m;
}

inline Vector4 product(const Matrix4& m, const Vector4& v)
{
    Vector4 result{};
    for (size_t i = 0; i < 4; ++i)
        for (size_t j = 0; j < 4; ++j)
            result[i] += m[i][j] * v[j];
    return result;
}

} // namespace hearth::visibility
