// How far a simplified group lies from the source, as a bound. See README.md, "Error".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/group_mesh.h"
#include "cook/clusters/simplify.h"
#include "cook/clusters/surface.h"

#include <cstdint>
#include <vector>

namespace hearth::clusters
{

struct Deviation
{
    /// For each triangle of the simplified group, in units of the group's mesh: no point of it is farther from the
    /// source, and no point of the source for which it stands is farther from it.
    std::vector<float> errors;
    Surface surface;           ///< that was measured: the simplified group's
    uint64_t loose_pieces = 0; ///< pieces whose bound was taken before the search for a better one ended
};

/// Carry the errors of the group's triangles on to those that replace them: a triangle's error is the largest, over the
/// triangles beside it on the other surface, of their error and the distance between the two, both ways. The largest of
/// all is searched for until 10 % more are certain; smaller ones may be looser.
Deviation boundDeviation(const GroupMesh& group, const Simplified& simplified);

} // namespace hearth::clusters
