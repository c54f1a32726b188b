// How far a simplified group lies from what it was, as a bound. See README.md, "Error".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/group_mesh.h"
#include "cook/clusters/simplify.h"

#include <cstdint>

namespace hearth::clusters
{

struct Deviation
{
    double distance = 0;       ///< in units of the group's mesh
    uint64_t loose_pieces = 0; ///< pieces whose bound was taken before the search for a better one ended
};

/// An upper bound of the two-sided distance between the surfaces: every point of the group's triangles has a point of
/// the simplified ones within it, and the other way round.
///
/// The largest distance of a triangle to one other triangle is at a corner, because the distance to a convex set is
/// convex. Triangles that lie across several others are cut where the nearest one changes until the pieces' bounds
/// are good enough: when the error that the distance is added to, `carried`, and the distance together are within 10 %
/// of what they are for sure.
Deviation boundDeviation(const GroupMesh& group, const Simplified& simplified, double carried);

} // namespace hearth::clusters
