// What becomes of one group: clusters with fewer triangles, and the error of drawing them instead.
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

struct Reduced
{
    bool progressed = false;              ///< false: the group is stuck and the rest says nothing
    ClusterStore clusters;                ///< vertices from kMadeVertex on are new ones
    mesh::SourceMesh made;                ///< attributes of made vertices
    std::vector<uint32_t> made_positions; ///< position of each, numbered from 0
    uint32_t made_position_count = 0;
    float distance = 0;       ///< object space: largest error of the clusters' triangles
    AttributeStep attributes; ///< of the clusters against the group's
    bool permissive = false;
    bool pruned = false;
    bool merged = false;
    uint64_t loose_pieces = 0;
};

/// Gather, simplify, measure and split a group.
///
/// members   clusters of `store`
/// locked    [position_count] positions that must stay
Reduced reduceGroup(const PreparedMesh& mesh, const ClusterStore& store, std::span<const uint32_t> members,
                    std::span<const uint8_t> locked, const GroupGoal& goal, const Config& config);

} // namespace hearth::clusters
