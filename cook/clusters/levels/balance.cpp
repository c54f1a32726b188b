// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/levels/balance.h"

#include "cook/clusters/core/group_mesh.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <map>

#include <tbb/parallel_for.h>

namespace hearth::clusters
{

namespace
{

CostStop stopAt(double cost, const GroupGoal& goal)
{
    const auto part = [&](double share)
    {
        const double kept = std::min(share * double{goal.keep}, double{kMaxKeep});
        return std::max<size_t>(1, static_cast<size_t>(kept * static_cast<double>(goal.source_triangles)));
    };
    return {cost, std::min(part(kMinShareFactor), goal.triangles),
            std::max(part(kMaxShareFactor), goal.triangles)};
}

/// Trial simplification of a group.
struct Trial
{
    GroupGoal goal;
    std::vector<CollapseStep> steps; ///< down to the minimum number of triangles

    /// Return the triangles that simplifyGroup would leave at a cost.
    size_t keptAt(double cost) const
    {
        const CostStop stop = stopAt(cost, goal);
        const auto first_too_costly = std::partition_point(
            steps.begin(), steps.end(), [&](const CollapseStep& step) { return step.cost <= cost; });
        if (steps.empty())
            return goal.triangles;
        if (first_too_costly == steps.end())
            return std::max(stop.min_triangles, std::min(steps.back().triangles, goal.triangles));
        const size_t left = first_too_costly == steps.begin() ? goal.source_triangles
                                                              : std::prev(first_too_costly)->triangles;
        return std::max(stop.min_triangles, roundToFullClusters(std::min(left, stop.max_triangles)));
    }
};

/// Return the lowest collapse cost at which the groups together reach their goals.
double balancedCost(std::span<const Trial> trials)
{
    std::vector<double> costs;
    size_t wanted = 0;
    for (const Trial& trial : trials)
    {
        wanted += trial.goal.triangles;
        for (const CollapseStep& step : trial.steps)
            costs.push_back(step.cost);
    }
    std::sort(costs.begin(), costs.end());
    const auto found = std::partition_point(costs.begin(), costs.end(),
                                            [&](double cost)
                                            {
                                                size_t kept = 0;
                                                for (const Trial& trial : trials)
                                                    kept += trial.keptAt(cost);
                                                return kept > wanted;
                                            });
    return found != costs.end() ? *found : costs.empty() ? 0.0 : costs.back();
}

void balanceAlike(const LevelView& level, std::span<const size_t> alike, std::span<GroupGoal> goals)
{
    std::vector<Trial> trials(alike.size());
    tbb::parallel_for(size_t{0}, trials.size(),
                      [&](size_t i)
                      {
                          const size_t g = alike[i];
                          const GroupMesh group =
                              gatherGroup(level.mesh, level.store, level.groups.groupMembers(g), level.locked,
                                          level.config);
                          trials[i] = {goals[g], collapseCosts(group, stopAt(0, goals[g]).min_triangles)};
                      });
    const double cost = balancedCost(trials);
    for (const size_t g : alike)
        goals[g].stop = stopAt(cost, goals[g]);
}

} // namespace

void balanceGoals(const LevelView& level, std::span<GroupGoal> goals)
{
    HEARTH_ASSERT(goals.size() == level.groups.count());
    HEARTH_ASSERT(level.locked.size() == level.mesh.position_count);
    std::map<float, std::vector<size_t>> groups_of_keep;
    for (size_t g = 0; g < goals.size(); ++g)
        groups_of_keep[goals[g].keep].push_back(g);
    for (const auto& [keep, alike] : groups_of_keep)
        if (alike.size() > 1)
            balanceAlike(level, alike, goals);
}

} // namespace hearth::clusters
