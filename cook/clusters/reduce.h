// What becomes of one group: clusters with half the triangles, and the error of drawing them instead.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/cluster.h"
#include "cook/clusters/hierarchy.h"

#include <cstdint>
#include <span>

namespace hearth::clusters
{

inline constexpr uint32_t kMadeVertex = 0x80000000u;

struct Reduced
{
    bool progressed = false;              ///< false: the group is stuck and the rest says nothing
    ClusterStore clusters;                ///< vertices from kMadeVertex on are those that were made
    mesh::SourceMesh made;                ///< attributes of made vertices
    std::vector<uint32_t> made_positions; ///< position of each, numbered from 0
    uint32_t made_position_count = 0;
    float error = 0; ///< object space: of the clusters against the source
    bool permissive = false;
    bool pruned = false;
    uint64_t loose_pieces = 0;
};

/// Gather, simplify, measure and split a group.
///
/// members         clusters of `store`
/// locked          [position_count] positions that must stay
/// members_error   largest error of the members against the source
Reduced reduceGroup(const PreparedMesh& mesh, const ClusterStore& store, std::span<const uint32_t> members,
                    std::span<const uint8_t> locked, float members_error, const Config& config);

} // namespace hearth::clusters
