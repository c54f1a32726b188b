// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/surface_points.h"

#include "cook/clusters/core/islands.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

namespace hearth::clusters
{

namespace
{

class PointFinder
{
public:
    PointFinder(const GroupMesh& group, const SimplifiedGroup& simplified, const Surface& after)
        : group_(group), simplified_(simplified), after_(after)
    {
        points_.of_position.resize(group.positions.size());
        points_.of_wedge.resize(group.vertex_of_wedge.size());
    }

    SurfacePoints run()
    {
        findSeams();
        findTargets();
        const ListsByTarget<WedgeId> wedges(targets_.size(), points_.of_wedge.size(),
                                            [&](WedgeId wedge)
                                            { return targets_[group_.position_id_of_wedge[wedge]]; });
        if (!simplified_.pruned && !simplified_.merged)
            points_.of_middle.resize(group_.triangleCount());
        if (!points_.of_middle.empty())
            for (const TriangleId triangle : simplified_.corners.triangles())
                takeOwnTriangle(simplified_.source_triangle[triangle], triangle);
        const ListsByTarget<TriangleId> triangles(
            targets_.size(), points_.of_middle.size(),
            [&](TriangleId triangle)
            { return points_.of_middle[triangle].triangle != kInvalid ? kInvalid : firstTarget(triangle); });
        for (const PositionId goal : targets_.ids())
        {
            if ((wedges.isEmpty(goal) && triangles.isEmpty(goal)) || after_.triangles_at.list(goal).empty())
                continue;
            fan_.load(after_.triangles, after_.triangles_at.list(goal));
            wedges.forEach(goal, [&](WedgeId wedge) { locate(wedge, points_.on_seam[goal] != 0); });
            triangles.forEach(goal, [&](TriangleId triangle)
                              { points_.of_middle[triangle] = fan_.nearest(triangleMiddle(triangle)); });
        }
        return std::move(points_);
    }

private:
    /// Linked lists of wedges or triangles by their target position.
    template <IndexType Item>
    class ListsByTarget
    {
    public:
        /// getTarget(item) is kInvalid for items of no list
        template <typename GetTarget>
        ListsByTarget(size_t position_count, size_t item_count, GetTarget getTarget)
            : head_(position_count, kInvalid), next_(item_count)
        {
            for (const Item item : next_.ids())
                if (const PositionId target = getTarget(item); target != kInvalid)
                    next_[item] = std::exchange(head_[target], item);
        }

        bool isEmpty(PositionId target) const { return head_[target] == kInvalid; }

        template <typename Visit>
        void forEach(PositionId target, Visit visit) const
        {
            for (Item item = head_[target]; item != kInvalid; item = next_[item])
                visit(item);
        }

    private:
        IdVector<PositionId, Item> head_;
        IdVector<Item, Item> next_;
    };

    void findTargets()
    {
        static_assert(kPruned == kInvalid);
        targets_.resize(group_.positions.size());
        for (const PositionId position : targets_.ids())
        {
            const PositionId target = simplified_.target_of_position[position];
            const bool stayed = position == target, modified = simplified_.placement.modified[position] != 0;
            const bool unchanged = stayed & !modified;
            targets_[position] = unchanged ? kInvalid : target;
        }
    }

    PositionId firstTarget(TriangleId triangle) const
    {
        const auto [a, b, c] = group_.corners.triangle(triangle);
        const PositionId goal_a = targets_[group_.position_id_of_wedge[a]];
        const PositionId goal_b = targets_[group_.position_id_of_wedge[b]];
        return goal_a != kInvalid   ? goal_a
               : goal_b != kInvalid ? goal_b
                                    : targets_[group_.position_id_of_wedge[c]];
    }

    /// Take the triangle's own remainder if its middle lies above it, as most do.
    void takeOwnTriangle(TriangleId triangle, TriangleId remaining)
    {
        const DistanceTriangle& remainder = after_.triangles[remaining];
        const Float3 away = triangleMiddle(triangle) - remainder.a;
        const float ab_ap = dot(remainder.ab, away), ac_ap = dot(remainder.ac, away);
        const float v = (remainder.ac_ac * ab_ap - remainder.ab_ac * ac_ap) * remainder.inverse_det;
        const float w = (remainder.ab_ab * ac_ap - remainder.ab_ac * ab_ap) * remainder.inverse_det;
        if (v > 0 && w > 0 && v + w < 1)
            points_.of_middle[triangle] = {remaining, v, w, 0};
    }

    Float3 triangleMiddle(TriangleId triangle) const
    {
        const auto [a, b, c] = group_.trianglePositions(triangle);
        return triangleCenter(a, b, c);
    }

    void findSeams()
    {
        points_.on_seam.assign(group_.positions.size(), 0);
        if (group_.positions.size() == group_.vertex_of_wedge.size())
            return;
        IdVector<PositionId, WedgeId> wedge_at(group_.positions.size(), kInvalid);
        for (const WedgeId wedge : simplified_.corners)
        {
            WedgeId& first = wedge_at[group_.position_id_of_wedge[wedge]];
            if (first == kInvalid)
                first = wedge;
            else if (first != wedge)
                points_.on_seam[group_.position_id_of_wedge[wedge]] = 1;
        }
    }

    void locate(WedgeId wedge, bool on_seam)
    {
        TrianglePoint& nearest = points_.of_position[group_.position_id_of_wedge[wedge]];
        if (nearest.triangle == kInvalid)
            nearest = fan_.nearest(group_.positions[group_.position_id_of_wedge[wedge]]);
        // inside a chart the fan is continuous
        points_.of_wedge[wedge] = on_seam ? nearestWithAttributes(wedge) : nearest;
    }

    /// Return the nearest point on each of the triangles, and of these the nearest one in position and
    /// attributes: at a seam this is on the wedge's own side.
    TrianglePoint nearestWithAttributes(WedgeId wedge) const
    {
        TrianglePoint best;
        float least = std::numeric_limits<float>::infinity();
        fan_.forEachNearest(group_.positions[group_.position_id_of_wedge[wedge]],
                            [&](const TrianglePoint& point)
                            {
                                const float cost = point.distance2 + attributeDistance2(wedge, point);
                                // the first serves if distances are NaN
                                if (cost < least || best.triangle == kInvalid)
                                {
                                    least = std::min(least, cost);
                                    best = point;
                                }
                            });
        return best;
    }

    float attributeDistance2(WedgeId wedge, const TrianglePoint& point) const
    {
        const Lanes* before = group_.wedgeAttributes(wedge);
        const std::array<WedgeId, 3> corners = simplified_.corners.triangle(point.triangle);
        const Lanes* rows[3];
        for (size_t k = 0; k < 3; ++k)
            rows[k] = simplified_.placement.attributes.data() + group_.firstRow(corners[k]);
        const Lanes v = splat(point.v), w = splat(point.w), u = splat(1 - point.v - point.w);
        Lanes sum{};
        for (size_t row = 0; row < group_.attribute_rows; ++row)
        {
            const Lanes away = rows[0][row] * u + rows[1][row] * v + rows[2][row] * w - before[row];
            sum += away * away;
        }
        return sumOfLanes(sum);
    }

    const GroupMesh& group_;
    const SimplifiedGroup& simplified_;
    const Surface& after_;
    SurfacePoints points_;
    /// Target of each position that was removed or moved; others: kInvalid.
    IdVector<PositionId, PositionId> targets_;
    TriangleFan fan_; ///< triangles around one position
};

} // namespace

SurfacePoints findPoints(const GroupMesh& group, const SimplifiedGroup& simplified, const Surface& after)
{
    HEARTH_ASSERT(after.triangleCount() == simplified.triangleCount());
    HEARTH_ASSERT(simplified.source_triangle.size() == simplified.triangleCount() &&
                  allBelow(simplified.source_triangle, group.triangleCount()));
    HEARTH_ASSERT(simplified.placement.positions.size() == group.positions.size());
    return PointFinder(group, simplified, after).run();
}

} // namespace hearth::clusters
