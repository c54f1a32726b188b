// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/simplify/cell_merge.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace hearth::clusters
{

namespace
{

// Cell sizes range from the whole group down to this part of it.
constexpr int kSteps = 12;
constexpr float kFinestCell = 1.0f / 256;

using Cell = std::array<int32_t, 4>; ///< and 1 if it is a cell of an open border

struct CellMembers
{
    Float3 sum;
    float count = 0;
    std::vector<PositionId> positions;
};

class CellMerger
{
public:
    CellMerger(const GroupMesh& group, SimplifiedGroup& simplified)
        : group_(group),
          simplified_(simplified),
          open_(markOpenPositions(group)),
          targets_(group.positions.size())
    {
        IdVector<PositionId, uint8_t> used(group.positions.size(), 0);
        for (const WedgeId wedge : simplified.corners)
            used[group.position_id_of_wedge[wedge]] = 1;
        for (const PositionId position : used.ids())
            if (used[position] != 0)
                used_.push_back(position);
    }

    void run(size_t target_triangles)
    {
        float coarse = 2.0f, fine = kFinestCell;
        for (int step = 0; step < kSteps; ++step)
        {
            const float cell = std::sqrt(coarse * fine);
            chooseTargets(cell);
            (keptTriangles().size() <= target_triangles ? coarse : fine) = cell;
        }
        chooseTargets(coarse);
        apply(keptTriangles());
    }

private:
    Float3 localPosition(PositionId position) const { return simplified_.placement.positions[position]; }

    /// Choose the target of each position: the nearest locked one in its cell, else the one nearest to the
    /// cell's mean. Positions of open borders merge only with each other, so that open edges lie on the
    /// source's borders.
    void chooseTargets(float cell_size)
    {
        std::map<Cell, CellMembers> cells;
        for (const PositionId p : used_)
        {
            targets_[p] = p;
            Cell cell{0, 0, 0, group_.locked[p] == 0 && open_[p] != 0 ? 1 : 0};
            for (int axis = 0; axis < 3; ++axis)
                cell[static_cast<size_t>(axis)] =
                    static_cast<int32_t>(std::floor(localPosition(p)[axis] / cell_size));
            CellMembers& members = cells[cell];
            members.sum += localPosition(p);
            members.count += 1;
            members.positions.push_back(p);
        }
        for (const auto& [cell, members] : cells)
        {
            std::vector<PositionId> locked_targets;
            for (const PositionId p : members.positions)
                if (group_.locked[p] != 0)
                    locked_targets.push_back(p);
            if (locked_targets.empty())
                locked_targets.push_back(nearest(members.sum / members.count, members.positions));
            for (const PositionId p : members.positions)
                if (group_.locked[p] == 0)
                    targets_[p] = nearest(localPosition(p), locked_targets);
        }
    }

    PositionId nearest(Float3 to, const std::vector<PositionId>& positions) const
    {
        const auto distance2 = [&](PositionId p)
        { return dot(localPosition(p) - to, localPosition(p) - to); };
        return *std::min_element(positions.begin(), positions.end(),
                                 [&](PositionId a, PositionId b) { return distance2(a) < distance2(b); });
    }

    PositionId targetPosition(CornerId corner) const
    {
        return targets_[group_.position_id_of_wedge[simplified_.corners[corner]]];
    }

    /// Return the triangles with three different corners, except pairs that cancel.
    std::vector<TriangleId> keptTriangles() const
    {
        // triangles with one orientation for each set of three positions, less those that cancel
        std::map<std::array<PositionId, 3>, std::vector<TriangleId>> by_corners;
        for (const TriangleId triangle : simplified_.corners.triangles())
        {
            std::array<PositionId, 3> c{targetPosition(makeCorner(triangle, 0)),
                                        targetPosition(makeCorner(triangle, 1)),
                                        targetPosition(makeCorner(triangle, 2))};
            if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0])
                continue;
            std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
            const auto opposite = by_corners.find({c[0], c[2], c[1]});
            if (opposite != by_corners.end() && !opposite->second.empty())
                opposite->second.pop_back();
            else
                by_corners[c].push_back(triangle);
        }
        std::vector<TriangleId> kept;
        for (const auto& [corners, triangles] : by_corners)
            kept.insert(kept.end(), triangles.begin(), triangles.end());
        std::sort(kept.begin(), kept.end());
        return kept;
    }

    void apply(const std::vector<TriangleId>& kept)
    {
        if (kept.empty())
            return;
        IdVector<PositionId, std::vector<WedgeId>> wedges_at(targets_.size());
        for (const WedgeId wedge : simplified_.corners)
        {
            auto& wedges = wedges_at[group_.position_id_of_wedge[wedge]];
            if (std::find(wedges.begin(), wedges.end(), wedge) == wedges.end())
                wedges.push_back(wedge);
        }
        SimplifiedGroup merged;
        for (const TriangleId triangle : kept)
        {
            for (const CornerId corner : makeCorners(triangle))
                merged.corners.push_back(
                    nearestWedge(simplified_.corners[corner], wedges_at[targetPosition(corner)]));
            merged.materials.push_back(simplified_.materials[triangle]);
            merged.source_triangle.push_back(simplified_.source_triangle[triangle]);
        }
        simplified_.corners = std::move(merged.corners);
        simplified_.materials = std::move(merged.materials);
        simplified_.source_triangle = std::move(merged.source_triangle);
        for (PositionId& target : simplified_.target_of_position)
            if (target != kPruned)
                target = targets_[target];
    }

    /// Return the wedge itself, or the one with the nearest attributes.
    WedgeId nearestWedge(WedgeId wedge, const std::vector<WedgeId>& wedges) const
    {
        return *std::min_element(
            wedges.begin(), wedges.end(),
            [&](WedgeId a, WedgeId b)
            {
                return a != b && (a == wedge || (b != wedge && attributeDistance2(group_, wedge, a) <
                                                                   attributeDistance2(group_, wedge, b)));
            });
    }

    const GroupMesh& group_;
    SimplifiedGroup& simplified_;
    IdVector<PositionId, uint8_t> open_;
    std::vector<PositionId> used_;             ///< positions that still have triangles
    IdVector<PositionId, PositionId> targets_; ///< target of each used position
};

} // namespace

void mergeByCells(const GroupMesh& group, size_t target_triangles, SimplifiedGroup& simplified)
{
    HEARTH_ASSERT(target_triangles > 0 && simplified.triangleCount() > 0);
    HEARTH_ASSERT(simplified.target_of_position.size() == group.positions.size());
    CellMerger(group, simplified).run(target_triangles);
    HEARTH_ASSERT(simplified.triangleCount() > 0);
    HEARTH_ASSERT(simplified.materials.size() == simplified.triangleCount() &&
                  simplified.source_triangle.size() == simplified.triangleCount());
}

} // namespace hearth::clusters
