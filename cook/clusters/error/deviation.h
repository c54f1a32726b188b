// How far a simplified group lies from the source, as a bound. See cook/clusters/README.md, "Error".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/simplify/simplify.h"
#include "cook/clusters/surface/surface.h"
#include "cook/clusters/surface/surface_points.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

struct Deviation
{
    /// For each triangle of the simplified group, in units of the group's mesh: no point of it is farther from the
    /// source, and no point of the source for which it stands is farther from it.
    std::vector<float> errors;
    uint64_t loose_pieces = 0; ///< pieces whose bound was taken before the search for a better one ended
};

/// Carry the errors of the group's triangles on to those that replace them: a triangle's error is the largest, over the
/// triangles beside it on the other surface, of their error and the distance between the two, both ways. The largest of
/// all is searched for until 10 % more are certain; smaller ones may be looser.
/// after   the simplified group's surface
/// points  where the group's positions lie on it, of those that went or moved
Deviation boundDeviation(const GroupMesh& group, const Simplified& simplified, const Surface& after,
                         std::span<const FacetPoint> points);

} // namespace hearth::clusters
