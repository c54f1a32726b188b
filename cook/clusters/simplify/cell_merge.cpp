// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/simplify/cell_merge.h"

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
    std::vector<uint32_t> positions;
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
        std::vector<uint8_t> used(group.positions.size(), 0);
        for (const uint32_t wedge : simplified.corners)
            used[group.position_id_of_wedge[wedge]] = 1;
        for (uint32_t p = 0; p < used.size(); ++p)
            if (used[p] != 0)
                used_.push_back(p);
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
    Float3 localPosition(uint32_t position) const { return simplified_.placement.positions[position]; }

    /// Choose the target of each position: the nearest locked one in its cell, else the one nearest to the
    /// cell's mean. Positions of open borders merge only with each other, so that open edges lie on the
    /// source's borders.
    void chooseTargets(float cell_size)
    {
        std::map<Cell, CellMembers> cells;
        for (const uint32_t p : used_)
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
            std::vector<uint32_t> locked_targets;
            for (const uint32_t p : members.positions)
                if (group_.locked[p] != 0)
                    locked_targets.push_back(p);
            if (locked_targets.empty())
                locked_targets.push_back(nearest(members.sum / members.count, members.positions));
            for (const uint32_t p : members.positions)
                if (group_.locked[p] == 0)
                    targets_[p] = nearest(localPosition(p), locked_targets);
        }
    }

    uint32_t nearest(Float3 to, const std::vector<uint32_t>& positions) const
    {
        const auto distance2 = [&](uint32_t p) { return dot(localPosition(p) - to, localPosition(p) - to); };
        return *std::min_element(positions.begin(), positions.end(),
                                 [&](uint32_t a, uint32_t b) { return distance2(a) < distance2(b); });
    }

    uint32_t targetPosition(size_t corner) const
    {
        return targets_[group_.position_id_of_wedge[simplified_.corners[corner]]];
    }

    /// Return the triangles with three different corners, except pairs that cancel.
    std::vector<uint32_t> keptTriangles() const
    {
        // triangles with one orientation for each set of three positions, less those that cancel
        std::map<std::array<uint32_t, 3>, std::vector<uint32_t>> by_corners;
        for (uint32_t t = 0; t < simplified_.triangleCount(); ++t)
        {
            std::array<uint32_t, 3> c{targetPosition(size_t{t} * 3), targetPosition(size_t{t} * 3 + 1),
                                      targetPosition(size_t{t} * 3 + 2)};
            if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0])
                continue;
            std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
            const auto opposite = by_corners.find({c[0], c[2], c[1]});
            if (opposite != by_corners.end() && !opposite->second.empty())
                opposite->second.pop_back();
            else
                by_corners[c].push_back(t);
        }
        std::vector<uint32_t> kept;
        for (const auto& [corners, triangles] : by_corners)
            kept.insert(kept.end(), triangles.begin(), triangles.end());
        std::sort(kept.begin(), kept.end());
        return kept;
    }

    void apply(const std::vector<uint32_t>& kept)
    {
        if (kept.empty())
            return;
        std::vector<std::vector<uint32_t>> wedges_at(targets_.size());
        for (const uint32_t wedge : simplified_.corners)
        {
            auto& wedges = wedges_at[group_.position_id_of_wedge[wedge]];
            if (std::find(wedges.begin(), wedges.end(), wedge) == wedges.end())
                wedges.push_back(wedge);
        }
        SimplifiedGroup merged;
        for (const uint32_t t : kept)
        {
            for (size_t corner = size_t{t} * 3; corner < size_t{t} * 3 + 3; ++corner)
                merged.corners.push_back(
                    nearestWedge(simplified_.corners[corner], wedges_at[targetPosition(corner)]));
            merged.materials.push_back(simplified_.materials[t]);
            merged.source_triangle.push_back(simplified_.source_triangle[t]);
        }
        simplified_.corners = std::move(merged.corners);
        simplified_.materials = std::move(merged.materials);
        simplified_.source_triangle = std::move(merged.source_triangle);
        for (uint32_t& target : simplified_.target_of_position)
            if (target != kPruned)
                target = targets_[target];
    }

    /// Return the wedge itself, or the one with the nearest attributes.
    uint32_t nearestWedge(uint32_t wedge, const std::vector<uint32_t>& wedges) const
    {
        return *std::min_element(
            wedges.begin(), wedges.end(),
            [&](uint32_t a, uint32_t b)
            {
                return a != b && (a == wedge || (b != wedge && attributeDistance2(group_, wedge, a) <
                                                                   attributeDistance2(group_, wedge, b)));
            });
    }

    const GroupMesh& group_;
    SimplifiedGroup& simplified_;
    std::vector<uint8_t> open_;
    std::vector<uint32_t> used_;    ///< positions that still have triangles
    std::vector<uint32_t> targets_; ///< target of each used position
};

} // namespace

void mergeByCells(const GroupMesh& group, size_t target_triangles, SimplifiedGroup& simplified)
{
    CellMerger(group, simplified).run(target_triangles);
}

} // namespace hearth::clusters
