// Thins out loose islands (leaves, pebbles, soup): removes some and grows the others.
// See cook/clusters/README.md, "Simplifying".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/simplify/star_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hearth::clusters
{

/// Larger islands keep their size: they are objects, not foliage.
inline constexpr size_t kMaxGrownTriangles = 16;

/// Growth of the remaining islands about their centers, which keeps the area of all removable islands
/// constant: a tree keeps its density when half of its leaves are removed.
struct Growth
{
    float factor = 1;                             ///< factor on lengths
    std::vector<std::vector<PositionId>> islands; ///< positions of each island that grows
};

/// Result of thinIslands.
struct Thinning
{
    bool pruned = false;
    Growth growth;
};

/// Remove whole islands that touch no locked position until `target_triangles` are left: small ones before
/// those twice as large, and among equals every other one along their order in space. Keeps at least one
/// triangle.
/// target_of_position  set to kPruned for removed positions
Thinning thinIslands(const GroupMesh& group, StarMesh& mesh, size_t target_triangles,
                     IdVector<PositionId, PositionId>& target_of_position);

} // namespace hearth::clusters
