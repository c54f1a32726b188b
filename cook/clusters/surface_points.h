// Where on the surface that a simplification leaves the positions and vertices lie that it took away or moved.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/group_mesh.h"
#include "cook/clusters/simplify.h"
#include "cook/clusters/surface.h"

#include <cstdint>
#include <vector>

namespace hearth::clusters
{

inline constexpr uint32_t kNoFacet = 0xFFFFFFFFu;

/// A point of a facet: (1 - v - w) * corner 0 + v * corner 1 + w * corner 2.
struct FacetPoint
{
    uint32_t facet = kNoFacet;
    float v = 0, w = 0;
    float distance2 = 0; ///< from what lies there
};

/// All of them among the facets around where a position went. None for positions that are as they were, and for those
/// that were pruned.
struct SurfacePoints
{
    std::vector<FacetPoint> of_position; ///< the nearest
    std::vector<FacetPoint>
        of_wedge; ///< the same, but at a seam the nearest with regard to the attributes as well
};

SurfacePoints findPoints(const GroupMesh& group, const Simplified& simplified, const Surface& after);

} // namespace hearth::clusters
