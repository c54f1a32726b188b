// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/surface_points.h"

#include "cook/clusters/core/islands.h"
#include "formats/base/index.h"

#include <algorithm>
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
        const KeyedLists wedges(targets_.size(), points_.of_wedge.size(),
                                [&](uint32_t wedge) { return targets_[group_.position_id_of_wedge[wedge]]; });
        if (!simplified_.pruned && !simplified_.merged)
            points_.of_middle.resize(group_.triangleCount());
        if (!points_.of_middle.empty())
            for (uint32_t t = 0; t < simplified_.triangleCount(); ++t)
                takeOwnTriangle(simplified_.source_triangle[t], t);
        const KeyedLists triangles(targets_.size(), points_.of_middle.size(),
                                   [&](uint32_t triangle) {
                                       return points_.of_middle[triangle].triangle != kInvalidIndex
                                                  ? kInvalidIndex
                                                  : firstTarget(triangle);
                                   });
        for (uint32_t goal = 0; goal < targets_.size(); ++goal)
        {
            if ((wedges.isEmpty(goal) && triangles.isEmpty(goal)) || after_.triangles_at.list(goal).empty())
                continue;
            fan_.load(after_.triangles, after_.triangles_at.list(goal));
            wedges.forEach(goal, [&](uint32_t wedge) { locate(wedge, points_.on_seam[goal] != 0); });
            triangles.forEach(goal, [&](uint32_t triangle)
                              { points_.of_middle[triangle] = fan_.nearest(triangleMiddle(triangle)); });
        }
        return std::move(points_);
    }

private:
    /// Linked lists of items by key.
    class KeyedLists
    {
    public:
        /// getKey(item) is kInvalidIndex for items of no list
        template <typename GetKey>
        KeyedLists(size_t key_count, size_t item_count, GetKey getKey)
            : head_(key_count, kInvalidIndex), next_(item_count)
        {
            for (uint32_t item = 0; item < item_count; ++item)
                if (const uint32_t key = getKey(item); key != kInvalidIndex)
                    next_[item] = std::exchange(head_[key], item);
        }

        bool isEmpty(uint32_t key) const { return head_[key] == kInvalidIndex; }

        template <typename Visit>
        void forEach(uint32_t key, Visit visit) const
        {
            for (uint32_t item = head_[key]; item != kInvalidIndex; item = next_[item])
                visit(item);
        }

    private:
        std::vector<uint32_t> head_;
        std::vector<uint32_t> next_;
    };

    void findTargets()
    {
        static_assert(kPruned == kInvalidIndex);
        targets_.resize(group_.positions.size());
        for (uint32_t position = 0; position < targets_.size(); ++position)
        {
            const uint32_t target = simplified_.target_of_position[position];
            const bool stayed = position == target, modified = simplified_.placement.modified[position] != 0;
            const bool unchanged = stayed & !modified;
            targets_[position] = unchanged ? kInvalidIndex : target;
        }
    }

    uint32_t firstTarget(uint32_t triangle) const
    {
        const uint32_t* wedges = &group_.corners[size_t{triangle} * 3];
        const uint32_t goal0 = targets_[group_.position_id_of_wedge[wedges[0]]];
        const uint32_t goal1 = targets_[group_.position_id_of_wedge[wedges[1]]];
        return goal0 != kInvalidIndex   ? goal0
               : goal1 != kInvalidIndex ? goal1
                                        : targets_[group_.position_id_of_wedge[wedges[2]]];
    }

    /// Take the triangle's own remainder if its middle lies above it, as most do.
    void takeOwnTriangle(uint32_t triangle, uint32_t number)
    {
        const DistanceTriangle& remainder = after_.triangles[number];
        const Float3 away = triangleMiddle(triangle) - remainder.a;
        const float ab_ap = dot(remainder.ab, away), ac_ap = dot(remainder.ac, away);
        const float v = (remainder.ac_ac * ab_ap - remainder.ab_ac * ac_ap) * remainder.inverse_det;
        const float w = (remainder.ab_ab * ac_ap - remainder.ab_ac * ab_ap) * remainder.inverse_det;
        if (v > 0 && w > 0 && v + w < 1)
            points_.of_middle[triangle] = {number, v, w, 0};
    }

    Float3 triangleMiddle(uint32_t triangle) const
    {
        const size_t corner = size_t{triangle} * 3;
        return triangleCenter(group_.positions[group_.positionIdAt(corner)],
                              group_.positions[group_.positionIdAt(corner + 1)],
                              group_.positions[group_.positionIdAt(corner + 2)]);
    }

    void findSeams()
    {
        points_.on_seam.assign(group_.positions.size(), 0);
        if (group_.positions.size() == group_.vertex_of_wedge.size())
            return;
        std::vector<uint32_t> wedge_at(group_.positions.size(), kInvalidIndex);
        for (const uint32_t wedge : simplified_.corners)
        {
            uint32_t& first = wedge_at[group_.position_id_of_wedge[wedge]];
            if (first == kInvalidIndex)
                first = wedge;
            else if (first != wedge)
                points_.on_seam[group_.position_id_of_wedge[wedge]] = 1;
        }
    }

    void locate(uint32_t wedge, bool on_seam)
    {
        TrianglePoint& nearest = points_.of_position[group_.position_id_of_wedge[wedge]];
        if (nearest.triangle == kInvalidIndex)
            nearest = fan_.nearest(group_.positions[group_.position_id_of_wedge[wedge]]);
        // inside a chart the fan is continuous
        points_.of_wedge[wedge] = on_seam ? nearestWithAttributes(wedge) : nearest;
    }

    /// Return the nearest point on each of the triangles, and of these the nearest one in position and
    /// attributes: at a seam this is on the wedge's own side.
    TrianglePoint nearestWithAttributes(uint32_t wedge) const
    {
        TrianglePoint best;
        float least = std::numeric_limits<float>::infinity();
        fan_.forEachNearest(group_.positions[group_.position_id_of_wedge[wedge]],
                            [&](const TrianglePoint& point)
                            {
                                const float cost = point.distance2 + attributeDistance2(wedge, point);
                                // the first serves if distances are NaN
                                if (cost < least || best.triangle == kInvalidIndex)
                                {
                                    least = std::min(least, cost);
                                    best = point;
                                }
                            });
        return best;
    }

    float attributeDistance2(uint32_t wedge, const TrianglePoint& point) const
    {
        const Lanes* before = group_.wedgeAttributes(wedge);
        const Lanes* rows[3];
        for (size_t k = 0; k < 3; ++k)
            rows[k] = simplified_.placement.attributes.data() +
                      size_t{simplified_.corners[point.triangle * 3 + k]} * group_.attribute_rows;
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
    std::vector<uint32_t>
        targets_;     ///< target of each position that was removed or moved; others: kInvalidIndex
    TriangleFan fan_; ///< triangles around one position
};

} // namespace

SurfacePoints findPoints(const GroupMesh& group, const SimplifiedGroup& simplified, const Surface& after)
{
    return PointFinder(group, simplified, after).run();
}

} // namespace hearth::clusters
