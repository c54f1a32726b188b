// Moves the positions that a simplification leaves to where their quadrics are minimal, and sets their
// attributes.
// See cook/clusters/README.md, "Placing".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/simplify/quadric.h"
#include "cook/clusters/simplify/star_mesh.h"
#include "cook/clusters/simplify/thinning.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Positions and attributes of a group after simplification: copies of the group's, except for those that
/// moved.
struct Placement
{
    IdVector<PositionId, Float3> positions; ///< local
    /// Object-space position on the grid of each modified position.
    IdVector<PositionId, Float3> object_positions;
    IdVector<PositionId, uint8_t> modified; ///< 1 for each position that moved or has new attributes
    std::vector<Lanes> attributes;          ///< rows of each wedge, weighted like the group's
};

/// Convert a local position to object space, on the grid. Positions leave the source's box by at most a
/// twentieth of its longest side: they stop there.
Float3 toObjectSpace(const GroupMesh& group, Float3 local);

Float3 toLocalSpace(const GroupMesh& group, Float3 object);

/// Move each `movable` position to the minimum of its quadric, on the mesh's grid, and give its wedges the
/// best attributes there. Positions whose triangles would flip move half as far, or stay.
Placement optimizePlacement(const GroupMesh& group, StarMesh& mesh, const Quadrics& quadrics,
                            IdSpan<PositionId, const uint8_t> movable);

/// Grow islands about their centers. An island grows no larger than the source's box, and moves inside it.
void growIslands(const GroupMesh& group, const Growth& growth, Placement& placement);

} // namespace hearth::clusters
