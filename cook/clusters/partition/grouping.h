// Groups of neighbouring clusters, to be simplified together. See cook/clusters/README.md, "Grouping".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/hierarchy.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Lists of clusters: the members of group g are members[offsets[g] .. offsets[g + 1]).
struct Groups
{
    std::vector<uint32_t> members;
    std::vector<uint32_t> offsets{0};

    size_t count() const { return offsets.size() - 1; }
    std::span<const uint32_t> membersOf(size_t group) const
    {
        return std::span(members).subspan(offsets[group], offsets[group + 1] - offsets[group]);
    }
};

/// Partition clusters into groups that share many positions. Always merges the smallest group with the neighbour that
/// it shares the longest border with for its size; borders that were locked on the level before count more, so that
/// they come to lie inside. What has no neighbour is merged by distance. A group's geometry fits one page.
///
/// store     all its clusters are grouped; at least one
/// locked    [position_count] positions that were locked on the level before
/// returns   groups in spatial order (Morton), members ascending
/// source    growing the smallest group first is the idea of meshoptimizer's meshopt_partitionClusters
Groups groupClusters(const PreparedMesh& mesh, const ClusterStore& store, std::span<const uint8_t> locked,
                     const Config& config);

/// Positions that several groups share, or that `pinned` names: [position_count], 1 where no group may move it.
std::vector<uint8_t> lockSharedPositions(const PreparedMesh& mesh, const ClusterStore& store,
                                         const Groups& groups, std::span<const uint8_t> pinned);

} // namespace hearth::clusters
