// T-junctions: vertices that lie within an edge of triangles that do not use them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/topology/edges.h"

#include <cstdint>
#include <vector>

namespace hearth::topology
{

struct TJunction
{
    uint32_t edge = 0;     ///< index of Edges::edges
    uint32_t position = 0; ///< id of the vertex within it

    friend bool operator==(const TJunction&, const TJunction&) = default;
};

/// Find the vertices within edges: at most `tolerance` from the edge, and farther than that from both
/// its ends. The third corner of a triangle at the edge is none: a needle is no T-junction. Ascending
/// by edge and position. Time O(n log n) for meshes of even edges.
std::vector<TJunction> findTJunctions(const Surface& surface, const Edges& edges, double tolerance);

} // namespace hearth::topology
