// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf_transform.h"

#include <cmath>
#include <limits>

namespace hearth::import
{

Transform operator*(const Transform& a, const Transform& b)
{
    Transform r;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
            r.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j] +
                        (j == 3 ? a.m[i][3] : 0.0);
    return r;
}

Transform transformFromTrs(const std::array<float, 3>& translation, const std::array<float, 4>& rotation,
                           const std::array<float, 3>& scale)
{
    const double x = rotation[0], y = rotation[1], z = rotation[2], w = rotation[3];
    const double r[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
        {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
        {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)},
    };
    Transform t;
    for (size_t i = 0; i < 3; ++i)
    {
        for (size_t j = 0; j < 3; ++j)
            t.m[i][j] = r[i][j] * static_cast<double>(scale[j]);
        t.m[i][3] = static_cast<double>(translation[i]);
    }
    return t;
}

std::optional<Transform> inverted(const Transform& transform)
{
    const auto& m = transform.m;
    Transform inverse;
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
        {
            // the cofactor of row j, column i
            const size_t r1 = (j + 1) % 3, r2 = (j + 2) % 3, c1 = (i + 1) % 3, c2 = (i + 2) % 3;
            inverse.m[i][j] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
        }
    const double det = m[0][0] * inverse.m[0][0] + m[0][1] * inverse.m[1][0] + m[0][2] * inverse.m[2][0];
    if (!(std::abs(det) > 0) || !std::isfinite(1 / det))
        return std::nullopt;
    for (auto& row : inverse.m)
    {
        for (size_t j = 0; j < 3; ++j)
            row[j] /= det;
        row[3] = -(row[0] * m[0][3] + row[1] * m[1][3] + row[2] * m[2][3]);
    }
    return inverse;
}

Transform transformFromColumns(std::span<const float, 16> columns)
{
    Transform t;
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 4; ++j)
            t.m[i][j] = static_cast<double>(columns[j * 4 + i]);
    return t;
}

std::optional<Affine3> narrowed(const Transform& transform)
{
    Affine3 result;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
        {
            if (!(std::abs(transform.m[i][j]) <= static_cast<double>(std::numeric_limits<float>::max())))
                return std::nullopt;
            result.m[i][j] = static_cast<float>(transform.m[i][j]);
        }
    return result;
}

double distance(const Transform& a, const Transform& b)
{
    double largest = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
            largest = std::max(largest, std::abs(a.m[i][j] - b.m[i][j]));
    return largest;
}

} // namespace hearth::import
