// Bounds the distance of a simplified group to the source. See cook/clusters/README.md, "Error".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/simplify/simplify.h"
#include "cook/clusters/surface/surface.h"
#include "cook/clusters/surface/surface_points.h"

#include <cstdint>

namespace hearth::clusters
{

/// Bound of the distance of a simplified group to the source.
struct Deviation
{
    /// Error of each triangle of the simplified group, in local units: no point of it is farther from the
    /// source, and no point of the source that it represents is farther from it.
    IdVector<TriangleId, float> errors;
    uint64_t loose_pieces = 0; ///< pieces whose search ended early, so that their bounds are not tight
};

/// Carry the errors of the group's triangles on to those that replace them. A triangle's error is the
/// largest, over the triangles beside it on the other surface, of their error and the distance between the
/// two, in both directions. The largest total is searched until its bound is within 10 %; smaller ones may be
/// looser.
/// after   the simplified group's surface
/// points  points of `after` to which the group's removed or moved positions map
Deviation boundDeviation(const GroupMesh& group, const SimplifiedGroup& simplified, const Surface& after,
                         IdSpan<PositionId, const TrianglePoint> points);

} // namespace hearth::clusters
