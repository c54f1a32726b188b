// Plain checks of closed surfaces, which share nothing with CGAL and its adapter: edges counted, each pair of
// triangles tried, solid angles summed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hearth::test
{

/// Triangles over positions.
struct CheckedSurface
{
    std::span<const Float3> positions;
    std::span<const uint32_t> indices;
};

/// True if every edge is used exactly once in each direction.
bool isWatertight(const CheckedSurface& surface);

/// Return the pairs of triangles that intersect, the smaller number first, sorted. Neighbours at an edge
/// intersect if they are folded onto each other, those at a corner if they meet beyond it.
std::vector<std::pair<uint32_t, uint32_t>> findCrossings(const CheckedSurface& surface);

/// Return how often the surface winds around a point: 1 inside of a closed surface, 0 outside.
double windingNumber(const CheckedSurface& surface, Double3 point);

/// Return the volume that a closed surface encloses.
double enclosedVolume(const CheckedSurface& surface);

} // namespace hearth::test
