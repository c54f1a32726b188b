// Where on the surface that a simplification leaves the positions and vertices lie that it took away or moved.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/facet_fan.h"
#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/simplify/simplify.h"
#include "cook/clusters/surface/surface.h"

#include <vector>

namespace hearth::clusters
{

/// Those of positions and wedges are among the facets around where the position went; none for positions that are as
/// they were, and for those that were pruned.
struct SurfacePoints
{
    std::vector<FacetPoint> of_position; ///< the nearest
    std::vector<FacetPoint>
        of_wedge; ///< the same, but at a seam the nearest with regard to the attributes as well
    /// Near the middle of each triangle: in what is left of the triangle, if the middle lies over that, else among the
    /// facets around where its first changed corner went. Empty where islands went or grew, or positions were merged by
    /// cells: what is left there is not meant to lie like that.
    std::vector<FacetPoint> of_middle;
    std::vector<uint8_t> on_seam; ///< for each position: several wedges are left at it
};

SurfacePoints findPoints(const GroupMesh& group, const Simplified& simplified, const Surface& after);

} // namespace hearth::clusters
