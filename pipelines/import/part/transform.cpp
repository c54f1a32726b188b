// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/transform.h"

#include <algorithm>
#include <cmath>

namespace hearth::import
{

Transform transformFromTrs(const std::array<float, 3>& translation, const std::array<float, 4>& rotation,
                           const std::array<float, 3>& scale)
{
    const auto wide = [](const std::array<float, 3>& v) { return widen(Float3{v[0], v[1], v[2]}); };
    return makeAffineFromTrs(wide(translation), {rotation[0], rotation[1], rotation[2], rotation[3]},
                             wide(scale));
}

Transform transformFromColumns(std::span<const float, 16> columns)
{
    Transform t;
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 4; ++j)
            t.m[i][j] = static_cast<double>(columns[j * 4 + i]);
    return t;
}

double distance(const Transform& a, const Transform& b)
{
    double largest = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
            largest = std::max(largest, std::abs(a.m[i][j] - b.m[i][j]));
    return largest;
}

double determinant(const Transform& t)
{
    const auto& m = t.m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

} // namespace hearth::import
