// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/simplify/wedge_map.h"

#include "cook/clusters/simplify/quadric.h"

namespace hearth::clusters
{

bool WedgeMap::mapAlong(uint32_t from, const Spoke& spoke)
{
    return mesh_.layers() == 1 ? mapWedges(spoke) : mapLayers(from, spoke.position);
}

bool WedgeMap::mapTo(uint32_t from, uint32_t to)
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
                                     [&](uint32_t wedge) { return findMoveOfChart(wedge) != nullptr; });
}

/// Map the wedges where several sheets coincide.
bool WedgeMap::mapLayers(uint32_t from, uint32_t to)
{
    moves_.clear();
    for (const Corner corner : mesh_.star(from))
    {
        const Corner next = nextCorner(corner);
        const Corner previous = previousCorner(corner);
        const Corner goal = mesh_.positionIdAt(next) == to ? next : previous;
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
const WedgeMove* WedgeMap::findMoveOfChart(uint32_t wedge) const
{
    const auto found = std::find_if(moves_.begin(), moves_.end(),
                                    [&](WedgeMove m) { return wedgeChart(m.from) == wedgeChart(wedge); });
    return found == moves_.end() ? nullptr : &*found;
}

void WedgeMap::mapRemaining(uint32_t to)
{
    if (complete())
        return;
    targets_.clear();
    for (const Corner corner : mesh_.star(to))
        if (const uint32_t wedge = mesh_.wedgeAt(corner);
            std::find(targets_.begin(), targets_.end(), wedge) == targets_.end())
            targets_.push_back(wedge);
    for (const uint32_t wedge : mesh_.wedges())
    {
        if (has(wedge))
            continue;
        const WedgeMove* guide = findMoveOfChart(wedge);
        uint32_t best = guide != nullptr ? guide->to : targets_.front();
        float best_distance2 = attributeDistance2(group_, wedge, best);
        for (const uint32_t goal : targets_)
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
}

bool WedgeMap::hasMoreThanTwoCharts() const
{
    const auto wedges = mesh_.wedges();
    if (wedges.size() <= 2)
        return false;
    const uint32_t first = wedgeChart(wedges[0]);
    uint32_t second = first;
    for (const uint32_t wedge : wedges.subspan(1))
    {
        const uint32_t chart = wedgeChart(wedge);
        if (chart == first || chart == second)
            continue;
        if (second != first)
            return true;
        second = chart;
    }
    return false;
}

} // namespace hearth::clusters
