// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/wrap/check.h"

#include "cook/mesh/triangles.h"
#include "cook/wrap/cgal_wrap.h"
#include "formats/base/disjoint_sets.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace hearth::wrap
{

namespace
{

/// Return a point of each piece of a surface: a wrap that touches no triangle has all of a piece on one side.
std::vector<Float3> findPieces(const Surface& surface)
{
    DisjointSets pieces(surface.positions.size());
    for (size_t i = 0; i < surface.indices.size(); i += 3)
        for (size_t k = 1; k < 3; ++k)
            pieces.unite(surface.indices[i], surface.indices[i + k]);
    std::vector<Float3> points;
    for (uint32_t point = 0; point < surface.positions.size(); ++point)
        if (pieces.find(point) == point)
            points.push_back(surface.positions[point]);
    return points;
}

std::vector<uint32_t> findCollapsed(const Surface& surface)
{
    std::vector<uint32_t> triangles;
    for (uint32_t i = 0; i < surface.triangleCount(); ++i)
    {
        const std::array<Float3, 3> corners = surface.corners(i);
        if (mesh::isDegenerate(corners[0], corners[1], corners[2]))
            triangles.push_back(i);
    }
    return triangles;
}

/// Find triangles with an edge that has not one triangle in each direction, or a vertex whose triangles are
/// not one fan.
std::vector<uint32_t> findNonManifold(const Surface& surface)
{
    const auto next = [](uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
    const std::vector<uint32_t>& indices = surface.indices;
    std::set<uint32_t> found;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> half_edges; // from the corner where they start
    for (uint32_t corner = 0; corner < indices.size(); ++corner)
        if (const auto [other, is_new] =
                half_edges.emplace(std::pair(indices[corner], indices[next(corner)]), corner);
            !is_new)
            found.insert({corner / 3, other->second / 3});
    DisjointSets fans(indices.size());
    for (const auto& [ends, corner] : half_edges)
        if (const auto opposite = half_edges.find({ends.second, ends.first}); opposite == half_edges.end())
            found.insert(corner / 3);
        else
            fans.unite(corner, next(opposite->second));
    std::map<uint32_t, uint32_t> fan_of_vertex;
    for (uint32_t corner = 0; corner < indices.size(); ++corner)
        if (const uint32_t fan = fans.find(corner);
            fan_of_vertex.emplace(indices[corner], fan).first->second != fan)
            found.insert(corner / 3);
    return {found.begin(), found.end()};
}

/// Number of pairs whose triangles are found at once.
constexpr size_t kMaxPairs = 4096;

std::vector<uint32_t> findIntersecting(const Surface& surface)
{
    // without a limit of time: the wrap had one, and took longer
    const SelfIntersections found =
        *findSelfIntersections(surface, kMaxPairs, std::numeric_limits<double>::infinity());
    std::set<uint32_t> triangles;
    for (const TrianglePair pair : found.pairs)
        triangles.insert({pair.a, pair.b});
    return {triangles.begin(), triangles.end()};
}

} // namespace

Fault findFault(const Surface& wrap, const SourceTree& source)
{
    if (wrap.indices.empty())
        return {"it is no surface", {}};
    if (std::vector<uint32_t> triangles = findCollapsed(wrap); !triangles.empty())
        return {"its triangles collapse", std::move(triangles)};
    if (std::vector<uint32_t> triangles = findNonManifold(wrap); !triangles.empty())
        return {"it is not watertight", std::move(triangles)};
    if (std::vector<uint32_t> triangles = findIntersecting(wrap); !triangles.empty())
        return {"it intersects itself", std::move(triangles)};
    if (std::vector<uint32_t> triangles = findTouching(wrap, source); !triangles.empty())
        return {"it touches the source", std::move(triangles)};
    if (!containsPoints(wrap, findPieces(source.surface())))
        return {"it leaves vertices of the source outside", {}};
    return {};
}

} // namespace hearth::wrap
