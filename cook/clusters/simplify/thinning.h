// What becomes of loose islands (leaves, pebbles, soup) that are too many: some go, the others grow.
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

/// Islands that stay grow about their middle, so that the area of all that may go stays the same: a tree keeps its
/// density when half of its leaves are gone.
struct Growth
{
    float factor = 1; ///< of lengths
    std::vector<uint32_t> positions;
    std::vector<Float3> centers; ///< for each of the positions, the middle of its island
};

struct Thinning
{
    bool pruned = false;
    Growth growth;
};

/// Remove whole islands that touch no locked position until `target_triangles` are left: small ones before those twice
/// as large, and among equals every other one along their order in space. Keeps at least one triangle.
/// target_of_position  gets kPruned for the positions of what goes
Thinning thinIslands(const GroupMesh& group, StarMesh& mesh, size_t target_triangles,
                     std::vector<uint32_t>& target_of_position);

} // namespace hearth::clusters
