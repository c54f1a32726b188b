// Where the positions that a simplification leaves are best placed, and with which attributes.
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

/// The group's positions and attributes after simplification: copies of the group's, but for what moved.
struct Placement
{
    std::vector<Float3> places;        ///< for each position, in units of the group's mesh
    std::vector<Float3> object_places; ///< for each position that is remade, on the grid
    std::vector<uint8_t> remade;       ///< for each position: it has another place or other attributes
    std::vector<Lanes> attributes;     ///< rows of each wedge, weighted as the group's
};

/// A local place in object space, on the grid.
Float3 objectPlace(const GroupMesh& group, Float3 local);

Float3 localPlace(const GroupMesh& group, Float3 object);

/// Move each position that is `movable` to where its quadrics are least, on the mesh's grid, and give its wedges the
/// attributes that are best there; positions whose triangles would turn over go half as far, or stay.
Placement placeOptimally(const GroupMesh& group, StarMesh& mesh, const Quadrics& quadrics,
                         std::span<const uint8_t> movable);

/// Move the positions of islands away from the islands' middles.
void growIslands(const GroupMesh& group, const Growth& growth, Placement& placement);

} // namespace hearth::clusters
