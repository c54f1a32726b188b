// Edges between exactly two triangles, with the corners opposite.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::visibility
{

/// One triangle has the corners a, b and k, the other a, b and l.
struct InteriorEdge
{
    uint32_t a; ///< less than b
    uint32_t b;
    uint32_t k;
    uint32_t l;
    uint32_t triangles[2]; ///< that of k, that of l; the first is the lesser

    friend bool operator==(const InteriorEdge&, const InteriorEdge&) = default;
};

/// The edges that exactly two of the triangles have, sorted by (a, b): borders and edges where three or more
/// triangles meet are not among them. Triangles may be oriented differently. Time and memory O(triangles).
/// indices  three different vertices for each triangle, less than vertex_count
std::vector<InteriorEdge> interiorEdges(std::span<const uint32_t> indices, size_t vertex_count);

} // namespace hearth::visibility
