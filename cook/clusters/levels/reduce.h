// Reduces one group to clusters with fewer triangles, and bounds the error of drawing them instead.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/error/attribute_error.h"
#include "cook/clusters/levels/level_plan.h"

#include <cstdint>
#include <span>

namespace hearth::clusters
{

/// Result of reducing a group.
struct GroupReduction
{
    bool progressed = false;                ///< false: the group is stuck and the other members are not set
    ClusterStore clusters;                  ///< some of its vertices are new ones
    mesh::SourceMesh made;                  ///< attributes of made vertices
    std::vector<uint32_t> new_position_ids; ///< position id of each made vertex, from 0
    uint32_t new_position_count = 0;
    float distance = 0;       ///< object space: largest error of the clusters' triangles
    AttributeStep attributes; ///< of the clusters relative to the group's
    bool permissive = false;
    bool pruned = false;
    bool merged = false;
    uint64_t loose_pieces = 0;
};

/// Gather, simplify, measure and split a group.
///
/// members   clusters of `store`
/// locked    1 for positions that must stay
GroupReduction reduceGroup(const PreparedMesh& mesh, const ClusterStore& store,
                           std::span<const ClusterId> members, IdSpan<MeshPositionId, const uint8_t> locked,
                           const GroupGoal& goal, const Config& config);

} // namespace hearth::clusters
