// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/clean/clean.h"

#include "cook/mesh/closest_point.h"
#include "formats/base/index.h"

#include <limits>
#include <optional>
#include <utility>

namespace hearth::proxy
{

namespace
{

/// Return the material of the triangle of `surface` that is nearest to the middle of three corners.
uint32_t nearestMaterial(const Surface& surface, const mesh::ClosestPoint& closest,
                         const std::array<Float3, 3>& corners)
{
    const Float3 middle = (corners[0] + corners[1] + corners[2]) * (1.0f / 3);
    const auto found = closest.find(middle, {}, std::numeric_limits<double>::infinity(), kInvalidIndex);
    return found.triangle == kInvalidIndex ? kInvalidIndex : surface.materials[found.triangle];
}

/// Remove thin and doubled triangles. Triangles that a flip made have the material of what lay there.
mesh::ThinTriangleStatistics removeThin(Surface& surface, double thinness)
{
    const mesh::CleanTriangles clean =
        mesh::removeThinTriangles(surface.positions, surface.indices, thinness);
    std::vector<uint32_t> materials;
    std::optional<mesh::ClosestPoint> closest;
    for (size_t t = 0; t < clean.source.size(); ++t)
    {
        if (clean.source[t] != kInvalidIndex)
        {
            materials.push_back(surface.materials[clean.source[t]]);
            continue;
        }
        if (!closest)
            closest.emplace(surface.view(), surface.triangleCount());
        materials.push_back(nearestMaterial(surface, *closest,
                                            {surface.positions[clean.indices[3 * t]],
                                             surface.positions[clean.indices[3 * t + 1]],
                                             surface.positions[clean.indices[3 * t + 2]]}));
    }
    surface.indices = clean.indices;
    surface.materials = std::move(materials);
    return clean.statistics;
}

} // namespace

CleanStatistics cleanSurface(Surface& surface, const CleanSettings& settings)
{
    const auto max_hole = static_cast<float>(double{findDiagonal(surface)} * settings.hole_length);
    CleanStatistics statistics;
    statistics.thin = removeThin(surface, settings.thinness);
    statistics.orientation = orientShells(surface);
    statistics.manifold = splitNonManifold(surface);
    statistics.holes = fillHoles(surface, max_hole);
    return statistics;
}

} // namespace hearth::proxy
