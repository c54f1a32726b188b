// Vertices whose triangles do not hang together.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/topology/edges.h"

#include <cstdint>
#include <vector>

namespace hearth::topology
{

/// Position at which the surface touches itself: its triangles form several fans, which share no edge
/// there.
struct NonManifoldVertex
{
    uint32_t position = 0;
    uint32_t fans = 0; ///< two or more

    friend bool operator==(const NonManifoldVertex&, const NonManifoldVertex&) = default;
};

/// Return the half-edge that starts at the position, which is an end of `half_edge`, in the same
/// triangle.
uint32_t cornerAt(const Surface& surface, uint32_t half_edge, uint32_t position);

/// Find the vertices with several fans. Triangles that share an edge at the position are of one fan,
/// however many share it. Ascending by position. Time about linear.
std::vector<NonManifoldVertex> findNonManifoldVertices(const Surface& surface, const Edges& edges);

} // namespace hearth::topology
