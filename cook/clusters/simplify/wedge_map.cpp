// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/simplify/wedge_map.h"

#include "cook/clusters/simplify/quadric.h"
#include "formats/base/assert.h"

namespace hearth::clusters
{

bool WedgeMap::mapAlong(PositionId from, const Spoke& spoke)
{
    return mesh_.layers() == 1 ? mapWedges(spoke) : mapLayers(from, spoke.position);
}

bool WedgeMap::mapTo(PositionId from, PositionId to)
{
    if (!mesh_.plain())
    {
        const Spoke* spoke = mesh_.spokeTo(to);
        return spoke != nullptr && mapAlong(from, *spoke);
    }
    const FanEnd* end = mesh_.endAt(to);
    if (end == nullptr)
        return false;
    moves_.assign(1, {mesh_.fanWedge(), end->wedge});
    return true;
}

bool WedgeMap::mapWedges(const Spoke& spoke)
{
    moves_.clear();
    if (spoke.out_count > 0)
        moves_.push_back(spoke.out);
    if (spoke.in_count > 0 && (moves_.empty() || spoke.in.from != spoke.out.from))
        moves_.push_back(spoke.in);
    else if (spoke.in_count > 0 && wedgeChart(spoke.in.to) != wedgeChart(spoke.out.to) && !permissive)
        return false;
    return permissive || std::all_of(mesh_.wedges().begin(), mesh_.wedges().end(),
                                     [&](WedgeId wedge) { return findMoveOfChart(wedge) != nullptr; });
}

/// Map the wedges where several sheets coincide.
bool WedgeMap::mapLayers(PositionId from, PositionId to)
{
    moves_.clear();
    for (const StarCorner corner : mesh_.star(from))
    {
        const StarCorner next = nextCorner(corner);
        const StarCorner previous = previousCorner(corner);
        const StarCorner goal = mesh_.positionIdAt(next) == to ? next : previous;
        if (mesh_.positionIdAt(goal) != to)
            continue;
        const WedgeMove move{mesh_.wedgeAt(corner), mesh_.wedgeAt(goal)};
        const auto known =
            std::find_if(moves_.begin(), moves_.end(), [&](WedgeMove m) { return m.from == move.from; });
        if (known == moves_.end())
            moves_.push_back(move);
        else if (known->to != move.to && !permissive)
            return false;
    }
    return permissive || moves_.size() == mesh_.wedges().size();
}

/// Return the move of a wedge of the same chart, or nullptr.
const WedgeMove* WedgeMap::findMoveOfChart(WedgeId wedge) const
{
    const auto found = std::find_if(moves_.begin(), moves_.end(),
                                    [&](WedgeMove m) { return wedgeChart(m.from) == wedgeChart(wedge); });
    return found == moves_.end() ? nullptr : &*found;
}

void WedgeMap::mapRemaining(PositionId to)
{
    if (complete())
        return;
    HEARTH_RUNTIME_ASSERT(mesh_.degree(to) > 0);
    targets_.clear();
    for (const StarCorner corner : mesh_.star(to))
        if (const WedgeId wedge = mesh_.wedgeAt(corner);
            std::find(targets_.begin(), targets_.end(), wedge) == targets_.end())
            targets_.push_back(wedge);
    for (const WedgeId wedge : mesh_.wedges())
    {
        if (has(wedge))
            continue;
        const WedgeMove* guide = findMoveOfChart(wedge);
        WedgeId best = guide != nullptr ? guide->to : targets_.front();
        float best_distance2 = attributeDistance2(group_, wedge, best);
        for (const WedgeId goal : targets_)
        {
            if (guide != nullptr && wedgeChart(goal) != wedgeChart(guide->to))
                continue;
            if (const float distance2 = attributeDistance2(group_, wedge, goal); distance2 < best_distance2)
            {
                best = goal;
                best_distance2 = distance2;
            }
        }
        moves_.push_back({wedge, best});
    }
    HEARTH_RUNTIME_ASSERT(complete());
}

bool WedgeMap::hasMoreThanTwoCharts() const
{
    const auto wedges = mesh_.wedges();
    if (wedges.size() <= 2)
        return false;
    const WedgeId first = wedgeChart(wedges[0]);
    WedgeId second = first;
    for (const WedgeId wedge : wedges.subspan(1))
    {
        const WedgeId chart = wedgeChart(wedge);
        if (chart == first || chart == second)
            continue;
        if (second != first)
            return true;
        second = chart;
    }
    return false;
}

} // namespace hearth::clusters
