// Maps the wedges of a collapsed position to wedges of its target. See cook/clusters/README.md,
// "Simplifying".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/simplify/star_mesh.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Wedge map of the position that is gathered in a star mesh.
class WedgeMap
{
public:
    WedgeMap(const GroupMesh& group, StarMesh& mesh) : group_(group), mesh_(mesh) {}

    bool permissive = false; ///< wedges may have no edge along the collapse

    /// Map the wedges for a collapse of the position along the spoke; false if one of them has no edge along
    /// it that keeps the attributes continuous.
    bool mapAlong(PositionId from, const Spoke& spoke);

    /// Map the wedges for a collapse to any neighbour; false for other positions.
    bool mapTo(PositionId from, PositionId to);

    /// Map wedges without an edge to the nearest attributes, in the chart that wedges of their own chart map
    /// to, if any.
    void mapRemaining(PositionId to);

    std::span<const WedgeMove> moves() const { return moves_; }
    bool has(WedgeId wedge) const
    {
        return std::any_of(moves_.begin(), moves_.end(), [&](WedgeMove m) { return m.from == wedge; });
    }
    bool complete() const { return mesh_.plain() || moves_.size() == mesh_.wedges().size(); }

    /// True if the wedges of the position belong to three charts or more.
    bool hasMoreThanTwoCharts() const;

private:
    bool mapWedges(const Spoke& spoke);
    bool mapLayers(PositionId from, PositionId to);
    WedgeId wedgeChart(WedgeId wedge) const { return group_.chart_of_wedge[wedge]; }
    const WedgeMove* findMoveOfChart(WedgeId wedge) const;

    const GroupMesh& group_;
    StarMesh& mesh_;
    std::vector<WedgeMove> moves_;
    std::vector<WedgeId> targets_; ///< scratch
};

} // namespace hearth::clusters
