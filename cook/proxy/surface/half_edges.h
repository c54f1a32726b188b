// Joins the triangles of any surface at their edges, so that it becomes a manifold: what cannot be joined is
// taken apart.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/proxy/surface/surface.h"

#include <cstdint>
#include <vector>

namespace hearth::proxy
{

/// Find the half-edge that each half-edge is joined with, or kInvalidIndex at a boundary. Two triangles
/// at an edge are joined if they pass it in opposite directions. More than two are joined in pairs that
/// bound the same solid, neighbours around the edge whose backs face each other, if that joins them all:
/// two boxes that share an edge stay two closed boxes. If it does not, the flattest pairs are joined: a
/// wall is taken off the floor.
std::vector<uint32_t> joinHalfEdges(const Surface& surface);

struct ManifoldStatistics
{
    uint32_t split_edges = 0;    ///< edges of more than two triangles, or of two that pass it the same way
    uint32_t split_vertices = 0; ///< copies of vertices at which several fans of triangles met
    uint32_t added_vertices = 0; ///< middles of edges whose two ends other triangles join in a second way
};

/// Take the surface apart where it is no manifold: afterwards each edge, by indices, has one triangle, or two
/// that pass it in opposite directions, and each vertex one fan of triangles. No point of the surface moves,
/// except for the rounding of added vertices.
/// surface  no triangle names a vertex twice, and no two have the same vertices
ManifoldStatistics splitNonManifold(Surface& surface);

} // namespace hearth::proxy
