// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/interior_edges.h"

#include <algorithm>

namespace hearth::mesh
{

namespace
{

/// Edge of a triangle, in the list of its lower vertex.
struct HalfEdge
{
    uint32_t other;
    uint32_t corner; ///< 3 * triangle + index of the opposite corner
};

struct HalfEdgeLists
{
    std::vector<uint32_t> first; ///< start of each vertex's list, then the total
    std::vector<HalfEdge> half_edges;
};

HalfEdgeLists halfEdgesByLowerVertex(std::span<const uint32_t> indices, size_t vertex_count)
{
    HalfEdgeLists lists;
    lists.first.assign(vertex_count + 1, 0);
    const auto ends = [&](size_t corner)
    {
        const size_t t = corner / 3 * 3, k = corner % 3;
        return std::minmax(indices[t + (k + 1) % 3], indices[t + (k + 2) % 3]);
    };
    for (size_t corner = 0; corner < indices.size(); ++corner)
        ++lists.first[ends(corner).first + 1];
    for (size_t v = 0; v < vertex_count; ++v)
        lists.first[v + 1] += lists.first[v];
    std::vector<uint32_t> next(lists.first.begin(), lists.first.end() - 1);
    lists.half_edges.resize(indices.size());
    for (size_t corner = 0; corner < indices.size(); ++corner)
    {
        const auto [lesser, greater] = ends(corner);
        lists.half_edges[next[lesser]++] = {greater, static_cast<uint32_t>(corner)};
    }
    return lists;
}

} // namespace

std::vector<InteriorEdge> findInteriorEdges(std::span<const uint32_t> indices, size_t vertex_count)
{
    HalfEdgeLists lists = halfEdgesByLowerVertex(indices, vertex_count);
    std::vector<InteriorEdge> edges;
    edges.reserve(indices.size() / 2);
    for (uint32_t a = 0; a < vertex_count; ++a)
    {
        const std::span<HalfEdge> half_edges(lists.half_edges.data() + lists.first[a],
                                             lists.half_edges.data() + lists.first[a + 1]);
        std::sort(half_edges.begin(), half_edges.end(),
                  [](HalfEdge x, HalfEdge y)
                  { return x.other != y.other ? x.other < y.other : x.corner < y.corner; });
        for (size_t i = 0, end = 0; i < half_edges.size(); i = end)
        {
            for (end = i; end < half_edges.size() && half_edges[end].other == half_edges[i].other;)
                ++end;
            if (end - i == 2)
                edges.push_back({a,
                                 half_edges[i].other,
                                 indices[half_edges[i].corner],
                                 indices[half_edges[i + 1].corner],
                                 {half_edges[i].corner / 3, half_edges[i + 1].corner / 3}});
        }
    }
    return edges;
}

} // namespace hearth::mesh
