// Plans the number of triangles that each group of a level keeps, and the weight of its error: the merge
// coefficient, group by group.
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

/// A group that achieves three tenths of its goal is no failure: with the default curve 85 triangles of 100
/// may stay. Halving one that achieves less again would cost more memory than it saves drawing.
inline constexpr double kMinProgress = 0.3;

/// Goal of a group's simplification.
struct GroupGoal
{
    size_t triangles = 1;
    size_t source_triangles = 1;  ///< triangles before
    float keep = 1;               ///< part of its triangles by the curve
    std::optional<CostStop> stop; ///< replaces `triangles`, which it reaches on average
    float error_weight = 1;
    /// A group that keeps more than this part of its triangles is stuck.
    float stuck_ratio = 1;
    /// True if one more cluster may be removed where that loses nothing.
    bool may_exceed = false;
    /// True if the count matters more than full clusters: a group with fewer triangles may then have no fewer
    /// clusters.
    bool exact = false;
};

/// Goals of all groups of a level.
struct LevelPlan
{
    std::vector<GroupGoal> goals; ///< for each group
    uint64_t target_triangles =
        0; ///< triangles of all groups together if the next level has a target, else 0
    /// Few groups of the source: some may keep more than their share where others keep less.
    bool balanced = false;
    double largest_part = 1; ///< maximum part of its triangles that a group may keep when goals are corrected
};

/// Plan the goals of the groups of level `level`. Without a target ahead, they follow the curves, rounded to
/// full clusters if that is at least one. With a target, the remaining reduction is spread evenly over the
/// levels up to it; at its own level the counts are exact.
///
/// drawn_below  triangles of roots of finer levels: they count for the targets
LevelPlan planLevel(const Reduction& reduction, uint32_t level, const ClusterStore& store,
                    const Groups& groups, uint64_t drawn_below);

/// True if the groups together made too little progress, like a single stuck group.
///
/// kept  triangles that each group kept
bool isStuck(const LevelPlan& plan, std::span<const size_t> kept);

/// Correct the goals for a target after some groups kept more than they should. False if the counts are close
/// enough, or nothing is left to correct.
///
/// kept     triangles that each group kept
/// changed  set to 1 for each group with a new goal
bool correctPlan(LevelPlan& plan, std::span<const size_t> kept, std::vector<uint8_t>& changed);

} // namespace hearth::clusters
