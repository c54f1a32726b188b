// Boundary loops: where a surface ends.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/topology/edges.h"

#include <cstdint>
#include <vector>

namespace hearth::topology
{

/// Path along edges of one triangle. At a position that it passes several times, it goes on along the
/// same fan of triangles.
struct BoundaryLoop
{
    std::vector<uint32_t> positions; ///< position ids; the first is not repeated at the end
    double length = 0;
    bool is_closed = true; ///< false: it ends at edges with more than two triangles

    size_t edgeCount() const { return positions.size() - (is_closed ? 0 : 1); }
};

/// Walk along all edges of one triangle. Longest loops first. Time linear, but for the sort.
std::vector<BoundaryLoop> findBoundaryLoops(const Surface& surface, const Edges& edges);

} // namespace hearth::topology
