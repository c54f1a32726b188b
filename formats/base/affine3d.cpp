// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/affine3d.h"

#include "formats/base/rounding.h"

#include <cmath>
#include <limits>

namespace hearth
{

Affine3d operator*(const Affine3d& a, const Affine3d& b)
{
    Affine3d r;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
            r.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j] +
                        (j == 3 ? a.m[i][3] : 0.0);
    return r;
}

Double3 transformVector(const Affine3d& transform, Double3 vector)
{
    const auto row = [&](const double(&m)[4]) { return m[0] * vector.x + m[1] * vector.y + m[2] * vector.z; };
    return {row(transform.m[0]), row(transform.m[1]), row(transform.m[2])};
}

Double3 transformPoint(const Affine3d& transform, Double3 point)
{
    return transformVector(transform, point) +
           Double3{transform.m[0][3], transform.m[1][3], transform.m[2][3]};
}

Double3 transformNormal(const Affine3d& transform, Double3 normal)
{
    const Double3 x = transformVector(transform, {1, 0, 0}), y = transformVector(transform, {0, 1, 0}),
                  z = transformVector(transform, {0, 0, 1});
    return cross(y, z) * normal.x + cross(z, x) * normal.y + cross(x, y) * normal.z;
}

Affine3d makeAffineFromTrs(Double3 translation, const std::array<double, 4>& rotation, Double3 scale)
{
    const double x = rotation[0], y = rotation[1], z = rotation[2], w = rotation[3];
    const double r[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
        {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
        {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)},
    };
    Affine3d t;
    const double scales[3] = {scale.x, scale.y, scale.z};
    const double translations[3] = {translation.x, translation.y, translation.z};
    for (size_t i = 0; i < 3; ++i)
    {
        for (size_t j = 0; j < 3; ++j)
            t.m[i][j] = r[i][j] * scales[j];
        t.m[i][3] = translations[i];
    }
    return t;
}

std::optional<Affine3d> inverted(const Affine3d& transform)
{
    const auto& m = transform.m;
    Affine3d inverse;
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
        {
            // cofactor of row j, column i
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

Affine3d widened(const Affine3& transform)
{
    Affine3d result;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
            result.m[i][j] = static_cast<double>(transform.m[i][j]);
    return result;
}

Box3 transformBox(const Affine3d& transform, const Box3& box)
{
    if (box.empty())
        return box;
    const Double3 low = widen(box.min), high = widen(box.max);
    const Double3 center = transformPoint(transform, (low + high) * 0.5);
    const Double3 half = (high - low) * 0.5;
    const double centers[3] = {center.x, center.y, center.z};
    Box3 result;
    for (int axis = 0; axis < 3; ++axis)
    {
        const auto& row = transform.m[axis];
        const double reach =
            std::abs(row[0]) * half.x + std::abs(row[1]) * half.y + std::abs(row[2]) * half.z;
        result.min[axis] = roundDown(centers[axis] - reach);
        result.max[axis] = roundUp(centers[axis] + reach);
    }
    return result;
}

std::optional<Affine3> narrowed(const Affine3d& transform)
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

} // namespace hearth
