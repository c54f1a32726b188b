// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/topology/vertex_fans.h"

#include "formats/base/disjoint_sets.h"

namespace hearth::topology
{

uint32_t cornerAt(const Surface& surface, uint32_t half_edge, uint32_t position)
{
    return surface.corners[half_edge] == position ? half_edge : nextHalfEdge(half_edge);
}

std::vector<NonManifoldVertex> findNonManifoldVertices(const Surface& surface, const Edges& edges)
{
    DisjointSets fans(surface.corners.size());
    for (const Edge& edge : edges.edges)
    {
        const std::span<const uint32_t> half_edges = edges.halfEdges(edge);
        for (size_t i = 1; i < half_edges.size(); ++i)
            for (const uint32_t end : {edge.from, edge.to})
                fans.unite(cornerAt(surface, half_edges[0], end), cornerAt(surface, half_edges[i], end));
    }
    std::vector<uint32_t> fans_of_position(surface.positions.size(), 0);
    for (uint32_t corner = 0; corner < surface.corners.size(); ++corner)
        if (fans.find(corner) == corner)
            ++fans_of_position[surface.corners[corner]];
    std::vector<NonManifoldVertex> found;
    for (uint32_t position = 0; position < fans_of_position.size(); ++position)
        if (fans_of_position[position] > 1)
            found.push_back({position, fans_of_position[position]});
    return found;
}

} // namespace hearth::topology
