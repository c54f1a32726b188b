// Pairs the half-edges of a triangulated surface with their opposites.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/index.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Half-edge number s belongs to triangle s / 3 and runs from its corner s % 3 to the next one.
inline uint32_t nextHalfEdge(uint32_t half_edge)
{
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}
inline uint32_t previousHalfEdge(uint32_t half_edge)
{
    return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

/// Return the opposite half-edge of each half-edge: the one that runs the other way between the same
/// positions. kInvalidIndex at a border, and where more than two half-edges lie between two positions.
///
/// positions  position ids, three for each triangle, below `position_count`
std::vector<uint32_t> findOppositeHalfEdges(std::span<const uint32_t> positions, size_t position_count);

} // namespace hearth::clusters
