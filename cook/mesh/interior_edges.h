// Finds the edges that exactly two triangles share, with the corners opposite to them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::mesh
{

/// Edge shared by the triangles (a, b, k) and (a, b, l).
struct InteriorEdge
{
    uint32_t a; ///< less than b
    uint32_t b;
    uint32_t k;
    uint32_t l;
    uint32_t triangles[2]; ///< triangle of k, triangle of l; the first index is lower

    friend bool operator==(const InteriorEdge&, const InteriorEdge&) = default;
};

/// Return the edges that exactly two triangles share, sorted by (a, b). Border edges, and edges where three
/// or more triangles meet, are left out. Triangles may be oriented differently. Time and memory O(triangles).
/// indices  three different vertices for each triangle, less than vertex_count
std::vector<InteriorEdge> findInteriorEdges(std::span<const uint32_t> indices, size_t vertex_count);

} // namespace hearth::mesh
