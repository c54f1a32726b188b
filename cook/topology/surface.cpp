// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/topology/surface.h"

#include "cook/mesh/triangles.h"
#include "cook/mesh/weld.h"
#include "formats/base/csr_lists.h"

#include <algorithm>
#include <array>
#include <utility>

namespace hearth::topology
{

namespace
{

using Corners = std::array<uint32_t, 3>;

/// Rotate the lowest corner to the front, which keeps the side that the triangle faces.
Corners rotateLowestFirst(Corners corners)
{
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

/// Find triangles with the corners of earlier ones.
/// triangles  with the lowest corner first; their corners differ
/// returns    pairs of indices of `triangles`
std::vector<DoubledTriangle> findDoubled(const std::vector<Corners>& triangles, size_t position_count)
{
    CsrLists<uint32_t> triangles_of_lowest(position_count,
                                           [&](const auto& add)
                                           {
                                               for (uint32_t t = 0; t < triangles.size(); ++t)
                                                   add(triangles[t][0], t);
                                           });
    const auto getOthers = [&](uint32_t triangle)
    {
        const auto& [lowest, b, c] = triangles[triangle];
        return std::pair(std::min(b, c), std::max(b, c));
    };
    std::vector<DoubledTriangle> doubled;
    for (size_t position = 0; position < position_count; ++position)
    {
        const std::span<uint32_t> list = triangles_of_lowest[position];
        std::sort(list.begin(), list.end(),
                  [&](uint32_t a, uint32_t b)
                  { return std::pair(getOthers(a), a) < std::pair(getOthers(b), b); });
        for (size_t i = 1, first = 0; i < list.size(); ++i)
            if (getOthers(list[i]) == getOthers(list[first]))
                doubled.push_back({list[first], list[i], triangles[list[first]][1] != triangles[list[i]][1]});
            else
                first = i;
    }
    std::sort(doubled.begin(), doubled.end(),
              [](const DoubledTriangle& a, const DoubledTriangle& b) { return a.copy < b.copy; });
    return doubled;
}

} // namespace

Surface makeSurface(const mesh::SourceMesh& mesh)
{
    Surface surface;
    const mesh::Weld weld = mesh::weldPositions(mesh.positions);
    surface.positions.resize(weld.position_count);
    for (size_t v = 0; v < mesh.vertexCount(); ++v)
        surface.positions[weld.position_id_of_vertex[v]] = mesh.positions[v];

    std::vector<Corners> triangles;
    std::vector<uint32_t> sources;
    for (uint32_t t = 0; t < mesh.triangleCount(); ++t)
    {
        Corners corners;
        for (uint32_t k = 0; k < 3; ++k)
            corners[k] = weld.position_id_of_vertex[mesh.indices[3 * t + k]];
        const auto& at = surface.positions;
        if (mesh::isDegenerate(at[corners[0]], at[corners[1]], at[corners[2]]))
        {
            surface.zero_area.push_back(t);
            continue;
        }
        triangles.push_back(rotateLowestFirst(corners));
        sources.push_back(t);
    }

    surface.doubled = findDoubled(triangles, weld.position_count);
    surface.corners.reserve(3 * triangles.size());
    auto copy = surface.doubled.begin();
    for (uint32_t t = 0; t < triangles.size(); ++t)
    {
        if (copy != surface.doubled.end() && copy->copy == t)
        {
            ++copy;
            continue;
        }
        surface.corners.insert(surface.corners.end(), triangles[t].begin(), triangles[t].end());
        surface.source_of_triangle.push_back(sources[t]);
    }
    for (DoubledTriangle& pair : surface.doubled)
    {
        pair.first = sources[pair.first];
        pair.copy = sources[pair.copy];
    }
    return surface;
}

} // namespace hearth::topology
