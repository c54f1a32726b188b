// Partitions clusters into groups of neighbours, to be simplified together. See cook/clusters/README.md,
// "Grouping".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/hierarchy.h"
#include "formats/base/assert.h"
#include "formats/base/csr_lists.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Lists of clusters.
struct Groups
{
    CsrLists<ClusterId> members; ///< of each group

    size_t count() const { return members.size(); }
    std::span<const ClusterId> groupMembers(size_t group) const
    {
        HEARTH_RUNTIME_ASSERT(group < count());
        return members[group];
    }
};

/// Partition clusters into groups that share many positions. Repeatedly merges the smallest group with the
/// neighbour that it shares the longest border with, relative to its size. Borders that were locked on the
/// previous level count more, so that they end up inside a group. Groups without neighbours are merged by
/// distance. A group's geometry fits in one page.
///
/// store     all its clusters are grouped; at least one
/// locked    1 for positions that were locked on the previous level
/// returns   groups in spatial order (Morton), members ascending
/// source    growing the smallest group first follows meshoptimizer's meshopt_partitionClusters
Groups groupClusters(const PreparedMesh& mesh, const ClusterStore& store,
                     IdSpan<MeshPositionId, const uint8_t> locked, const Config& config);

/// Return locks: 1 for each position that several groups share or that is in `pinned`.
IdVector<MeshPositionId, uint8_t> lockSharedPositions(const PreparedMesh& mesh, const ClusterStore& store,
                                                      const Groups& groups,
                                                      IdSpan<MeshPositionId, const uint8_t> pinned);

} // namespace hearth::clusters
