// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/levels/level_plan.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hearth::clusters
{

namespace
{

using formats::kMaxClusterTriangles;

// A target counts as met within this; users are promised 3 %.
constexpr double kTargetSlack = 0.01;

// With more groups, a cut takes finer ones where there is more to lose. With few, each is so large a part of
// the mesh that a cut cannot: the groups themselves have to keep more or less.
constexpr size_t kMaxBalancedGroups = 12;

struct GroupShare
{
    size_t triangles = 0;
    LevelStep step;
};

GroupShare groupShare(const Reduction& reduction, uint32_t level, const ClusterStore& store,
                      std::span<const ClusterId> members)
{
    GroupShare share;
    std::vector<uint32_t> materials;
    for (const ClusterId member : members)
    {
        share.triangles += store.shapes[member].triangle_count;
        if (materials.empty() || materials.back() != store.shapes[member].material)
            materials.push_back(store.shapes[member].material);
    }
    share.step = findGroupStep(reduction, level, materials);
    return share;
}

/// Round up or down to full clusters, so that over many groups the sum is that of the exact counts. If that
/// would leave a group unchanged, return the exact count.
size_t nearestClusters(double triangles, size_t of)
{
    const auto clusters = static_cast<size_t>(std::lround(triangles / kMaxClusterTriangles));
    const size_t rounded = clusters * kMaxClusterTriangles;
    return rounded >= 1 && rounded < of ? rounded : std::max<size_t>(1, static_cast<size_t>(triangles));
}

/// Return the factor on every group's `keep` with which the groups together keep
/// `target_triangles` triangles, and each at most `largest_part` of its own.
double spreadFactor(std::span<const GroupShare> shares, double target_triangles, double largest_part)
{
    double low = 0;
    double high = 1 / double{kMinKeep};
    // far finer than one triangle in 2^31
    constexpr int kHalvings = 60;
    for (int i = 0; i < kHalvings; ++i)
    {
        const double factor = (low + high) / 2;
        double sum = 0;
        for (const GroupShare& share : shares)
            sum += static_cast<double>(share.triangles) *
                   std::min(largest_part, factor * double{share.step.keep});
        (sum < target_triangles ? low : high) = factor;
    }
    return high;
}

GroupGoal makeGoal(const GroupShare& share, double part)
{
    GroupGoal goal;
    goal.source_triangles = share.triangles;
    goal.error_weight = share.step.error_weight;
    goal.keep = share.step.keep;
    goal.stuck_ratio = static_cast<float>(1 - kMinProgress * (1 - part));
    return goal;
}

/// Return the next target that is coarser than the current level, or nullptr.
const LevelTarget* findNextTarget(const Reduction& reduction, uint32_t level, uint64_t drawn_below,
                                  uint64_t triangles)
{
    const auto found = std::find_if(reduction.targets.begin(), reduction.targets.end(),
                                    [&](const LevelTarget& target) { return target.level > level; });
    const bool possible = found != reduction.targets.end() && found->triangles > drawn_below &&
                          found->triangles - drawn_below < triangles;
    return possible ? &*found : nullptr;
}

/// Plan goals whose sum is that of their exact values.
void planExactly(LevelPlan& plan, std::span<const GroupShare> shares, double factor, double largest_part)
{
    double exact = 0;
    double handed_out = 0;
    for (const GroupShare& share : shares)
    {
        const double part = std::min(largest_part, factor * double{share.step.keep});
        GroupGoal goal = makeGoal(share, part);
        goal.exact = true;
        exact += part * static_cast<double>(share.triangles);
        goal.triangles = static_cast<size_t>(std::max(1.0, std::round(exact - handed_out)));
        handed_out += static_cast<double>(goal.triangles);
        plan.goals.push_back(goal);
    }
}

} // namespace

LevelPlan planLevel(const Reduction& reduction, uint32_t level, const ClusterStore& store,
                    const Groups& groups, uint64_t drawn_below)
{
    HEARTH_ASSERT(groups.count() > 0 && groups.members.items().size() == store.shapes.size());
    LevelPlan plan;
    std::vector<GroupShare> shares;
    uint64_t triangles = 0;
    for (size_t g = 0; g < groups.count(); ++g)
    {
        shares.push_back(groupShare(reduction, level, store, groups.groupMembers(g)));
        triangles += shares.back().triangles;
    }
    const LevelTarget* target = findNextTarget(reduction, level, drawn_below, triangles);
    if (target == nullptr)
    {
        for (const GroupShare& share : shares)
        {
            plan.goals.push_back(makeGoal(share, double{share.step.keep}));
            const auto kept = static_cast<size_t>(static_cast<float>(share.triangles) * share.step.keep);
            plan.goals.back().triangles = std::max<size_t>(1, roundToFullClusters(kept));
            plan.goals.back().may_exceed = true;
        }
        plan.balanced = level == 0 && groups.count() <= kMaxBalancedGroups;
        return plan;
    }

    HEARTH_ASSERT(target->level > level && target->triangles > drawn_below);
    const uint32_t steps = target->level - level;
    const auto remaining = static_cast<double>(target->triangles - drawn_below);
    const double part = std::pow(remaining / static_cast<double>(triangles), 1.0 / steps);
    const double target_triangles = part * static_cast<double>(triangles);
    // a group that cannot shrink leaves its share to the others
    const double largest_part = std::max(part, double{kMaxKeep});
    const double factor = spreadFactor(shares, target_triangles, largest_part);
    planExactly(plan, shares, factor, largest_part);
    if (steps == 1)
    {
        plan.target_triangles = target->triangles - drawn_below;
        plan.largest_part = largest_part;
    }
    else
        for (size_t g = 0; g < shares.size(); ++g)
            plan.goals[g].triangles =
                nearestClusters(static_cast<double>(plan.goals[g].triangles), shares[g].triangles);
    return plan;
}

bool isStuck(const LevelPlan& plan, std::span<const size_t> kept)
{
    HEARTH_ASSERT(kept.size() == plan.goals.size());
    double source_triangles = 0;
    double planned = 0;
    for (const GroupGoal& goal : plan.goals)
    {
        source_triangles += static_cast<double>(goal.source_triangles);
        planned += static_cast<double>(goal.triangles);
    }
    const double left = static_cast<double>(std::accumulate(kept.begin(), kept.end(), size_t{0}));
    return left > source_triangles - kMinProgress * (source_triangles - planned);
}

bool correctPlan(LevelPlan& plan, std::span<const size_t> kept, std::vector<uint8_t>& changed)
{
    HEARTH_ASSERT(kept.size() == plan.goals.size());
    const auto target_triangles = static_cast<double>(plan.target_triangles);
    double sum = 0;
    double stiff = 0;    // kept by groups that cannot reach their goals
    double flexible = 0; // kept by the others
    changed.assign(kept.size(), 0);
    for (size_t g = 0; g < kept.size(); ++g)
    {
        sum += static_cast<double>(kept[g]);
        // a collapse removes two triangles, more where triangles coincide
        changed[g] = kept[g] <= plan.goals[g].triangles + 4 ? 1 : 0;
        (changed[g] != 0 ? flexible : stiff) += static_cast<double>(kept[g]);
    }
    if (plan.target_triangles == 0 || std::abs(sum - target_triangles) <= kTargetSlack * target_triangles ||
        flexible == 0 || stiff >= target_triangles)
        return false;
    const double factor = (target_triangles - stiff) / flexible;
    for (size_t g = 0; g < kept.size(); ++g)
    {
        GroupGoal& goal = plan.goals[g];
        const double corrected = std::round(factor * static_cast<double>(goal.triangles));
        if (changed[g] != 0)
            goal.triangles = static_cast<size_t>(
                std::clamp(corrected, 1.0,
                           std::max(1.0, plan.largest_part * static_cast<double>(goal.source_triangles))));
    }
    return true;
}

} // namespace hearth::clusters
