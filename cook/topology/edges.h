// Edges of a surface with their triangles, and edges that are faults by themselves.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/topology/surface.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::topology
{

/// Edge between two positions, from the lower id to the higher one.
struct Edge
{
    uint32_t from = 0;
    uint32_t to = 0;
    uint32_t first = 0; ///< of its half-edges in Edges::half_edges
    uint32_t count = 0; ///< as many as triangles
};

struct Edges
{
    std::vector<Edge> edges; ///< ascending by (from, to)
    /// edge by edge, in the order of triangles
    std::vector<uint32_t> half_edges;
    /// By half-edge: the other one at an edge of exactly two triangles, whichever way they run; else
    /// kInvalidIndex.
    std::vector<uint32_t> opposite;

    std::span<const uint32_t> halfEdges(const Edge& edge) const
    {
        return {half_edges.data() + edge.first, edge.count};
    }
};

/// Sort the half-edges of a surface by edge. Time O(n log n).
Edges findEdges(const Surface& surface);

/// True if two half-edges of one edge run the same way: then their triangles face different sides.
inline bool runsAlong(const Surface& surface, uint32_t half_edge, uint32_t other)
{
    return surface.corners[half_edge] == surface.corners[other];
}

/// Return the edges with more than two triangles, as indices, ascending.
std::vector<uint32_t> findNonManifoldEdges(const Edges& edges);

/// Return the edges of two triangles that face different sides, as indices, ascending.
std::vector<uint32_t> findInconsistentEdges(const Surface& surface, const Edges& edges);

} // namespace hearth::topology
