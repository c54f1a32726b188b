// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/topology/edges.h"

#include "formats/base/csr_lists.h"
#include "formats/base/index.h"

#include <algorithm>

namespace hearth::topology
{

Edges findEdges(const Surface& surface)
{
    const std::vector<uint32_t>& corners = surface.corners;
    const auto higherEnd = [&](uint32_t half_edge)
    { return std::max(corners[half_edge], corners[nextHalfEdge(half_edge)]); };
    CsrLists<uint32_t> half_edges_of_lower(surface.positions.size(),
                                           [&](const auto& add)
                                           {
                                               for (uint32_t h = 0; h < corners.size(); ++h)
                                                   add(std::min(corners[h], corners[nextHalfEdge(h)]), h);
                                           });

    Edges edges;
    edges.half_edges.reserve(corners.size());
    edges.opposite.assign(corners.size(), kInvalidIndex);
    for (uint32_t position = 0; position < surface.positions.size(); ++position)
    {
        const std::span<uint32_t> list = half_edges_of_lower[position];
        std::sort(list.begin(), list.end(),
                  [&](uint32_t a, uint32_t b)
                  {
                      const uint32_t end_a = higherEnd(a), end_b = higherEnd(b);
                      return end_a != end_b ? end_a < end_b : a < b;
                  });
        for (const uint32_t half_edge : list)
        {
            const uint32_t to = higherEnd(half_edge);
            if (edges.edges.empty() || edges.edges.back().from != position || edges.edges.back().to != to)
                edges.edges.push_back({position, to, static_cast<uint32_t>(edges.half_edges.size()), 0});
            ++edges.edges.back().count;
            edges.half_edges.push_back(half_edge);
        }
    }
    for (const Edge& edge : edges.edges)
        if (edge.count == 2)
        {
            const std::span<const uint32_t> pair = edges.halfEdges(edge);
            edges.opposite[pair[0]] = pair[1];
            edges.opposite[pair[1]] = pair[0];
        }
    return edges;
}

std::vector<uint32_t> findNonManifoldEdges(const Edges& edges)
{
    std::vector<uint32_t> found;
    for (uint32_t e = 0; e < edges.edges.size(); ++e)
        if (edges.edges[e].count > 2)
            found.push_back(e);
    return found;
}

std::vector<uint32_t> findInconsistentEdges(const Surface& surface, const Edges& edges)
{
    std::vector<uint32_t> found;
    for (uint32_t e = 0; e < edges.edges.size(); ++e)
    {
        const std::span<const uint32_t> pair = edges.halfEdges(edges.edges[e]);
        if (pair.size() == 2 && runsAlong(surface, pair[0], pair[1]))
            found.push_back(e);
    }
    return found;
}

} // namespace hearth::topology
