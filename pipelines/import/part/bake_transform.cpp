// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/bake_transform.h"

#include "pipelines/import/part/import_options.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hearth::import
{

namespace
{

using Direction = std::array<double, 3>;

Float3 unitOr(const Direction& d, Float3 fallback)
{
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (!(length > 0) || !std::isfinite(length))
        return fallback;
    return {static_cast<float>(d[0] / length), static_cast<float>(d[1] / length),
            static_cast<float>(d[2] / length)};
}

/// Return the linear part, or its transpose, times a direction.
Direction transformDirection(const Transform& t, Float3 v, bool transposed)
{
    Direction d{};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
            d[i] += (transposed ? t.m[j][i] : t.m[i][j]) * double{v[static_cast<int>(j)]};
    return d;
}

} // namespace

bool bakeTransform(mesh::SourceMesh& mesh, const Transform& transform)
{
    const std::optional<Transform> inverse = inverted(transform);
    if (!inverse)
        return false;
    std::vector<Float3> positions;
    positions.reserve(mesh.positions.size());
    for (const Float3 p : mesh.positions)
    {
        Direction moved = transformDirection(transform, p, false);
        for (size_t i = 0; i < 3; ++i)
            moved[i] += transform.m[i][3];
        if (std::any_of(moved.begin(), moved.end(),
                        [](double c) { return !(std::abs(c) <= kMaxCoordinate); }))
            return false;
        positions.push_back(
            {static_cast<float>(moved[0]), static_cast<float>(moved[1]), static_cast<float>(moved[2])});
    }
    mesh.positions = std::move(positions);
    // normals are transformed by the inverse transpose
    for (Float3& normal : mesh.normals)
        normal = unitOr(transformDirection(*inverse, normal, true), normal);
    const bool mirrored = determinant(transform) < 0;
    for (Float4& tangent : mesh.tangents)
    {
        const Float3 t = {tangent.x, tangent.y, tangent.z};
        const Float3 moved = unitOr(transformDirection(transform, t, false), t);
        tangent = {moved.x, moved.y, moved.z, mirrored ? -tangent.w : tangent.w};
    }
    if (mirrored)
        for (size_t t = 0; t < mesh.indices.size(); t += 3)
            std::swap(mesh.indices[t + 1], mesh.indices[t + 2]);
    return true;
}

} // namespace hearth::import
