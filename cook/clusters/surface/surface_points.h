// Projects removed or moved positions and vertices to the simplified surface.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/core/triangle_fan.h"
#include "cook/clusters/simplify/simplify.h"
#include "cook/clusters/surface/surface.h"

namespace hearth::clusters
{

/// Points of positions and wedges are among the triangles around the target of the position; none for
/// unchanged positions and for pruned ones.
struct SurfacePoints
{
    IdVector<PositionId, TrianglePoint> of_position; ///< nearest point
    /// Nearest point; at a seam the nearest one that takes attributes into account as well.
    IdVector<WedgeId, TrianglePoint> of_wedge;
    /// Point near the middle of each triangle: in the remainder of the triangle, if the middle lies over
    /// that, else among the triangles around the target of its first changed corner. Empty if islands were
    /// pruned or grown, or positions were merged by cells: the rest is not meant to lie like that.
    IdVector<TriangleId, TrianglePoint> of_middle;
    IdVector<PositionId, uint8_t> on_seam; ///< 1 for positions at which several wedges remain
};

SurfacePoints findPoints(const GroupMesh& group, const SimplifiedGroup& simplified, const Surface& after);

} // namespace hearth::clusters
