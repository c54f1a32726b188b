// Finds connected pieces (islands) of a mesh, and keeps small ones together for splitting.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/index_types.h"
#include "formats/base/math.h"

#include <cstdint>
#include <vector>

namespace hearth::clusters
{

/// Return the smallest position of each triangle's island; or wedge or vertex, whatever connects the corners.
/// corners  all below `limit`
template <IndexType Id>
IdVector<TriangleId, Id> islandOfTriangles(const CornerVector<Id>& corners, size_t limit);

/// Set the centers that the splitter uses. Triangles of an island of at most 32 triangles move to the
/// island's center, so that a leaf, a pebble or a small chart is not torn apart between clusters. Islands are
/// by vertex here: pieces that share no vertex cost nothing to separate.
///
/// centers  of the triangles, changed in place
/// corners  vertices or wedges, all below `limit`
template <IndexType Id>
void moveToIslandCenters(IdSpan<TriangleId, Float3> centers, const CornerVector<Id>& corners, size_t limit);

/// Return the center of a triangle, without overflow for any finite corners.
inline Float3 triangleCenter(Float3 a, Float3 b, Float3 c)
{
    constexpr float kThird = 1.0f / 3.0f;
    return a * kThird + b * kThird + c * kThird;
}

} // namespace hearth::clusters
