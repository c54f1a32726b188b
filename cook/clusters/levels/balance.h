// Balances the collapse costs of the groups of a level, so that all lose equally. See
// cook/clusters/README.md, "Balance".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/levels/level_plan.h"

namespace hearth::clusters
{

/// Level before its groups are simplified.
struct LevelView
{
    const PreparedMesh& mesh;
    const ClusterStore& store;
    const Groups& groups;
    IdSpan<MeshPositionId, const uint8_t> locked;
    const Config& config;
};

/// Range of its share of triangles that a group may keep.
inline constexpr double kMinShareFactor = 0.6;
inline constexpr double kMaxShareFactor = 1.5;

/// Let groups stop where collapses begin to cost the same in all of them, at a cost that leaves the sum of
/// their goals. Groups with different `keep` are balanced separately. Takes a third of the time of
/// simplifying them.
void balanceGoals(const LevelView& level, std::span<GroupGoal> goals);

} // namespace hearth::clusters
