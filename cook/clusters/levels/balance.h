// What a collapse may cost in the groups of a level, so that all of them lose alike: see cook/clusters/README.md, "Balance".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/levels/level_plan.h"

namespace hearth::clusters
{

/// A level before its groups are simplified.
struct LevelView
{
    const PreparedMesh& mesh;
    const ClusterStore& store;
    const Groups& groups;
    std::span<const uint8_t> locked; ///< for each position
    const Config& config;
};

/// A group may keep from so much of its share up to so much of it.
inline constexpr double kLeastOfShare = 0.6;
inline constexpr double kMostOfShare = 1.5;

/// Let groups stop where collapses begin to cost the same in all of them, at a cost that leaves what their goals come to
/// together. Groups whose curves ask them to keep different parts are balanced apart. Takes a third of the time of
/// simplifying them.
void balanceGoals(const LevelView& level, std::span<GroupGoal> goals);

} // namespace hearth::clusters
