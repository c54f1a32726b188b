// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/error/deviation.h"

#include "cook/clusters/core/triangle_boxes.h"
#include "cook/clusters/surface/nearest_bound.h"
#include "cook/clusters/surface/surface.h"
#include "cook/clusters/surface/surface_map.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hearth::clusters
{

namespace
{

// Rounding of a distance between points in [-1, 1]^3: a few times 2^-23, with margin.
constexpr float kRounding = 2e-6f;

// Maximum likely triangles of a search, and those that are guessed from the triangles' order.
constexpr size_t kMaxLikely = 5 * kLanes;
constexpr size_t kNeighbours = 2 * kLanes;

// A distance below this part of a triangle's size is mostly rounding.
constexpr float kFlat = 1e-4f;

// Part of a carried error that may be added to a distance without a closer search.
constexpr float kSlackOfCarried = kSlack - 1;

/// Short list of triangles, each once.
class LikelyTriangles
{
public:
    explicit LikelyTriangles(size_t triangle_count) : list_of_triangle_(triangle_count, 0) {}

    void clear()
    {
        ++list_;
        triangles_.clear();
    }

    void addAround(const Surface& surface, PositionId position)
    {
        for (const TriangleId triangle : surface.triangles_at.list(position))
            add(triangle);
    }

    /// Add the triangles around the corner where a half-edge starts.
    void addAround(IdSpan<HalfEdgeId, const HalfEdgeId> opposites, HalfEdgeId start)
    {
        HalfEdgeId half_edge = start;
        do
        {
            add(cornerTriangle(half_edge));
            half_edge = opposites[previousHalfEdge(half_edge)];
        } while (half_edge != kInvalid && half_edge != start);
        if (half_edge == start)
            return;
        for (half_edge = opposites[start]; half_edge != kInvalid;
             half_edge = opposites[nextHalfEdge(half_edge)])
            add(cornerTriangle(half_edge));
    }

    void add(TriangleId triangle)
    {
        if (list_of_triangle_[triangle] == list_ || triangles_.size() == kMaxLikely)
            return;
        list_of_triangle_[triangle] = list_;
        triangles_.push_back(triangle);
    }

    std::span<const TriangleId> triangles() const { return triangles_; }

private:
    IdVector<TriangleId, uint32_t> list_of_triangle_; ///< number of the last list with each triangle
    uint32_t list_ = 0;
    std::vector<TriangleId> triangles_;
};

/// Upper bound of a triangle's total: its carried error plus its distance.
struct Total
{
    float upper;
    TriangleId triangle;
    bool before;

    bool operator<(const Total& b) const
    {
        return upper != b.upper     ? upper < b.upper
               : before != b.before ? before < b.before
                                    : triangle < b.triangle;
    }
};

/// Bounds the triangles before that were removed or changed, and the new ones.
class DeviationMeasure
{
public:
    DeviationMeasure(const GroupMesh& group, const SimplifiedGroup& simplified, const Surface& after,
                     IdSpan<PositionId, const TrianglePoint> points)
        : group_(group),
          simplified_(simplified),
          after_(after),
          positions_before_(gatherPositionIds(group, group.corners)),
          moved_(movedPositions()),
          changed_(changedTriangles()),
          map_(group, simplified, positions_before_, after, points, changed_),
          index_before_(positions_before_, group.positions),
          index_after_(after.position_ids, after.position_of_id),
          likely_before_(changed_.size()),
          likely_after_(after.triangleCount()),
          unsearched_errors_(group.errors),
          searched_after_(after.triangleCount(), 0),
          errors_(after.triangleCount(), 0)
    {
    }

    Deviation run()
    {
        for (const TriangleId t : errors_.ids())
            if (const TriangleId source = simplified_.source_triangle[t]; changed_[source] == 0)
                errors_[t] = group_.errors[source];
        sums_ = map_.maxSums(group_.errors);
        resolveLargest();
        // triangles that were searched on both sides have raised errors by less than the map's sums
        const IdVector<TriangleId, float> unsearched_sums = map_.maxSums(unsearched_errors_);
        for (const TriangleId t : errors_.ids())
        {
            const float sum = searched_after_[t] != 0 ? unsearched_sums[t] : sums_[t];
            raiseError(t, std::min(sum, worst_));
            errors_[t] += kRounding;
        }
        return {std::move(errors_), nearest_.loosePieces()};
    }

private:
    IdVector<PositionId, uint8_t> movedPositions() const
    {
        IdVector<PositionId, uint8_t> moved(simplified_.placement.modified);
        for (const PositionId position : moved.ids())
            moved[position] =
                simplified_.target_of_position[position] != position ? uint8_t{1} : moved[position];
        return moved;
    }

    IdVector<TriangleId, uint8_t> changedTriangles() const
    {
        IdVector<TriangleId, uint8_t> changed(group_.triangleCount(), 1);
        for (const TriangleId source : simplified_.source_triangle)
        {
            const auto [a, b, c] = positions_before_.triangle(source);
            changed[source] = static_cast<uint8_t>(moved_[a] | moved_[b] | moved_[c]);
        }
        return changed;
    }

    /// Call visit(total) for all changed triangles whose total by the map is at least `least` (>= 0). Few
    /// are: that is the only branch.
    template <typename Visit>
    void forEachTotal(const float& least, Visit visit) const
    {
        const auto upperBound = [](uint8_t changed, bool known, float sum)
        {
            const float upper = known ? sum : kInfinity;
            return changed != 0 ? upper : -1.0f;
        };
        for (const TriangleId t : changed_.ids())
        {
            const float upper = upperBound(changed_[t], map_.maps(t), group_.errors[t] + map_.maxDistance(t));
            if (upper >= least)
                visit(Total{upper, t, true});
        }
        for (const TriangleId t : sums_.ids())
        {
            const float upper =
                upperBound(changed_[simplified_.source_triangle[t]], map_.covers(t), sums_[t]);
            if (upper >= least)
                visit(Total{upper, t, false});
        }
    }

    /// Search the largest totals first: once one needs no search, neither do the others. The largest of all
    /// rules most of them out.
    void resolveLargest()
    {
        Total largest{0, TriangleId{0}, false};
        bool changed = false;
        forEachTotal(largest.upper,
                     [&](const Total& total)
                     {
                         changed = true;
                         largest = std::max(largest, total);
                     });
        if (!changed)
            return;
        resolve(largest);
        std::vector<Total> larger;
        forEachTotal(worst_,
                     [&](const Total& total)
                     {
                         if (total.upper > worst_ && total < largest)
                             larger.push_back(total);
                     });
        std::make_heap(larger.begin(), larger.end());
        for (; !larger.empty() && larger.front().upper > worst_; larger.pop_back())
        {
            resolve(larger.front());
            std::pop_heap(larger.begin(), larger.end());
        }
    }

    void resolve(const Total& total)
    {
        if (isRounding(total))
        {
            worst_ = std::max(worst_, total.upper);
            return;
        }
        total.before ? searchBefore(total.triangle) : searchAfter(total.triangle);
    }

    /// True if all distances are rounding, as on a plane, where a search is useless.
    bool isRounding(const Total& total) const
    {
        const Corners corners =
            total.before ? cornersBefore(total.triangle) : after_.triangleCorners(total.triangle);
        const Float3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0];
        const float carried = total.before ? group_.errors[total.triangle] : 0.0f;
        return total.upper - carried <= kFlat * std::sqrt(std::max(dot(e1, e1), dot(e2, e2)));
    }

    void raiseError(TriangleId triangle, float error)
    {
        errors_[triangle] = std::max(errors_[triangle], error);
    }

    Corners cornersBefore(TriangleId triangle) const
    {
        const auto [a, b, c] = positions_before_.triangle(triangle);
        return {group_.positions[a], group_.positions[b], group_.positions[c]};
    }

    void searchBefore(TriangleId t)
    {
        const float carried = group_.errors[t];
        likely_after_.clear();
        if (map_.maps(t))
            map_.forEachSourceTriangle(t, [&](TriangleId triangle) { likely_after_.add(triangle); });
        for (const PositionId position : positions_before_.triangle(t))
            if (const PositionId target = simplified_.target_of_position[position];
                target != kPruned && moved_[position] != 0)
                likely_after_.addAround(after_, target);
        if (likely_after_.triangles().empty())
            addNeighboursInOrder(t);
        const float distance =
            nearest_.bound(cornersBefore(t), index_after_, likely_after_.triangles(), tolerance(carried));
        for (const NearestBound::UsedTriangle& used : nearest_.used())
            raiseError(used.triangle, carried + used.distance);
        unsearched_errors_[t] = -kInfinity;
        worst_ = std::max(worst_, carried + distance);
    }

    void searchAfter(TriangleId t)
    {
        float carried = 0;
        likely_before_.clear();
        for (const CornerId corner : makeCorners(simplified_.source_triangle[t]))
            if (moved_[positions_before_[corner]] != 0)
                likely_before_.addAround(map_.oppositesBefore(), corner);
        for (const TriangleId triangle : likely_before_.triangles())
            carried = std::max(carried, group_.errors[triangle]);
        nearest_.bound(after_.triangleCorners(t), index_before_, likely_before_.triangles(),
                       tolerance(carried));
        float total = 0;
        for (const NearestBound::UsedTriangle& used : nearest_.used())
            total = std::max(total, group_.errors[used.triangle] + used.distance);
        raiseError(t, total);
        searched_after_[t] = 1;
        worst_ = std::max(worst_, total);
    }

    /// Return the tolerance of a search: nothing is gained below the largest total so far.
    Tolerance tolerance(float carried) const { return {worst_ - carried, carried * kSlackOfCarried}; }

    /// Add new triangles that are close to an old one in the clusters' order: a fair guess for islands that
    /// were removed.
    void addNeighboursInOrder(TriangleId source)
    {
        const auto& left = simplified_.source_triangle;
        const auto after =
            static_cast<size_t>(std::lower_bound(left.begin(), left.end(), source) - left.begin());
        const size_t last_start = left.size() - std::min(left.size(), kNeighbours);
        const size_t start = std::min(after - std::min(after, kNeighbours / 2), last_start);
        for (size_t i = start; i < std::min(start + kNeighbours, left.size()); ++i)
            likely_after_.add(toId<TriangleId>(i));
    }

    const GroupMesh& group_;
    const SimplifiedGroup& simplified_;
    const Surface& after_;
    CornerVector<PositionId> positions_before_;
    IdVector<PositionId, uint8_t> moved_;   ///< 1 for positions that are not where they were
    IdVector<TriangleId, uint8_t> changed_; ///< 1 for triangles before that were removed or changed
    SurfaceMap map_;
    TriangleBoxes index_before_;
    TriangleBoxes index_after_;
    IdVector<TriangleId, float> sums_; ///< for each triangle after, SurfaceMap::maxSums
    LikelyTriangles likely_before_;
    LikelyTriangles likely_after_;
    NearestBound nearest_;
    /// Errors of the group's triangles; -infinity for those that were searched.
    IdVector<TriangleId, float> unsearched_errors_;
    IdVector<TriangleId, uint8_t> searched_after_; ///< 1 for triangles after that were searched
    float worst_ = 0;                              ///< largest total so far, among those that were searched
    IdVector<TriangleId, float> errors_;           ///< for each triangle after
};

} // namespace

Deviation boundDeviation(const GroupMesh& group, const SimplifiedGroup& simplified, const Surface& after,
                         IdSpan<PositionId, const TrianglePoint> points)
{
    HEARTH_ASSERT(simplified.triangleCount() > 0 && after.triangleCount() == simplified.triangleCount());
    HEARTH_ASSERT(points.size() == group.positions.size());
    HEARTH_ASSERT(group.errors.size() == group.triangleCount());
    Deviation deviation = DeviationMeasure(group, simplified, after, points).run();
    HEARTH_ASSERT(deviation.errors.size() == after.triangleCount());
    return deviation;
}

} // namespace hearth::clusters
