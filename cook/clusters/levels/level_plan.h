// How many triangles each group of a level shall keep, and how its error counts: the merge coefficient, group by group.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/reduction.h"
#include "cook/clusters/partition/grouping.h"
#include "cook/clusters/simplify/simplify.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// A group that does three tenths of what it should is no failure: with the default curve 85 triangles of 100 may
/// stay. Halving one that does less again would cost more memory than it saves drawing.
inline constexpr double kLeastProgress = 0.3;

/// What a group shall become.
struct GroupGoal
{
    size_t triangles = 1;
    size_t of = 1;                ///< triangles that it has
    float keep = 1;               ///< what the curve says
    std::optional<CostStop> stop; ///< decides in place of `triangles`, which is what it comes to in the mean
    float error_weight = 1;
    /// A group that keeps more than this part of its triangles is stuck.
    float stuck_ratio = 1;
    /// A cluster more may go where nothing is lost by it.
    bool may_go_on = false;
    /// The count matters more than full clusters: a group with fewer triangles may have no fewer clusters.
    bool exact = false;
};

struct LevelPlan
{
    std::vector<GroupGoal> goals; ///< for each group
    uint64_t wanted = 0; ///< triangles of all groups together where the next level is a target's, else 0
    bool balanced =
        false; ///< few groups of the source: some may keep more than their share where others keep less
    double largest_part = 1; ///< of its triangles that a group may keep where the goals are corrected
};

/// The goals of the groups of level `level`. Without a target ahead, what the curves say, as full clusters where that
/// is at least one. With one, what is left to do is spread evenly over the levels up to it; at its own the counts
/// are exact.
///
/// drawn_below  triangles of groups of finer levels that stay: they count for the targets
LevelPlan planLevel(const Reduction& reduction, uint32_t level, const ClusterStore& store,
                    const Groups& groups, uint64_t drawn_below);

/// Whether the groups together did too little, as one group can.
///
/// kept  triangles that each group kept
bool isStuck(const LevelPlan& plan, std::span<const size_t> kept);

/// What a target asks of the other groups after some kept more than they should. False where the counts are near
/// enough, or nothing is left to correct.
///
/// kept     triangles that each group kept
/// changed  gets 1 for each group whose goal is new
bool correctPlan(LevelPlan& plan, std::span<const size_t> kept, std::vector<uint8_t>& changed);

} // namespace hearth::clusters
