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
    explicit LikelyTriangles(size_t facet_count) : list_of_triangle_(facet_count, 0) {}

    void clear()
    {
        ++list_;
        triangles_.clear();
    }

    void addAround(const Surface& surface, uint32_t position)
    {
        for (const uint32_t triangle : surface.triangles_at.list(position))
            add(triangle);
    }

    /// Add the triangles around the corner where a half-edge starts.
    void addAround(std::span<const uint32_t> opposites, uint32_t start)
    {
        uint32_t half_edge = start;
        do
        {
            add(half_edge / 3);
            half_edge = opposites[previousHalfEdge(half_edge)];
        } while (half_edge != kInvalidIndex && half_edge != start);
        if (half_edge == start)
            return;
        for (half_edge = opposites[start]; half_edge != kInvalidIndex;
             half_edge = opposites[nextHalfEdge(half_edge)])
            add(half_edge / 3);
    }

    void add(uint32_t triangle)
    {
        if (list_of_triangle_[triangle] == list_ || triangles_.size() == kMaxLikely)
            return;
        list_of_triangle_[triangle] = list_;
        triangles_.push_back(triangle);
    }

    std::span<const uint32_t> triangles() const { return triangles_; }

private:
    std::vector<uint32_t> list_of_triangle_; ///< number of the last list that contained each triangle
    uint32_t list_ = 0;
    std::vector<uint32_t> triangles_;
};

/// Upper bound of a triangle's total: its carried error plus its distance.
struct Total
{
    float upper;
    uint32_t triangle;
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
                     std::span<const TrianglePoint> points)
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
          errors_(after.triangleCount(), 0)
    {
    }

    Deviation run()
    {
        for (uint32_t t = 0; t < after_.triangleCount(); ++t)
            if (const uint32_t source = simplified_.source_triangle[t]; changed_[source] == 0)
                errors_[t] = group_.errors[source];
        sums_ = map_.maxSums(group_.errors);
        resolveLargest();
        for (uint32_t t = 0; t < errors_.size(); ++t)
        {
            // larger sums come from triangles that were searched
            raiseError(t, std::min(sums_[t], worst_));
            errors_[t] += kRounding;
        }
        return {std::move(errors_), nearest_.loosePieces()};
    }

private:
    std::vector<uint8_t> movedPositions() const
    {
        std::vector<uint8_t> moved(simplified_.placement.modified);
        for (uint32_t position = 0; position < moved.size(); ++position)
            moved[position] =
                simplified_.target_of_position[position] != position ? uint8_t{1} : moved[position];
        return moved;
    }

    std::vector<uint8_t> changedTriangles() const
    {
        std::vector<uint8_t> changed(group_.triangleCount(), 1);
        for (const size_t source : simplified_.source_triangle)
            changed[source] =
                static_cast<uint8_t>(moved(source * 3) | moved(source * 3 + 1) | moved(source * 3 + 2));
        return changed;
    }

    uint32_t targetPosition(size_t corner) const
    {
        return simplified_.target_of_position[positions_before_[corner]];
    }

    uint8_t moved(size_t corner) const { return moved_[positions_before_[corner]]; }

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
        for (uint32_t t = 0; t < changed_.size(); ++t)
        {
            const float upper = upperBound(changed_[t], map_.maps(t), group_.errors[t] + map_.maxDistance(t));
            if (upper >= least)
                visit(Total{upper, t, true});
        }
        for (uint32_t t = 0; t < sums_.size(); ++t)
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
        Total largest{0, 0, false};
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

    void raiseError(uint32_t triangle, float error)
    {
        errors_[triangle] = std::max(errors_[triangle], error);
    }

    Corners cornersBefore(size_t t) const
    {
        return {group_.positions[positions_before_[t * 3]], group_.positions[positions_before_[t * 3 + 1]],
                group_.positions[positions_before_[t * 3 + 2]]};
    }

    void searchBefore(uint32_t t)
    {
        const float carried = group_.errors[t];
        likely_after_.clear();
        if (map_.maps(t))
            map_.forEachTriangleOf(t, [&](uint32_t triangle) { likely_after_.add(triangle); });
        for (size_t corner = size_t{t} * 3; corner < size_t{t} * 3 + 3; ++corner)
            if (const uint32_t target = targetPosition(corner); target != kPruned && moved(corner) != 0)
                likely_after_.addAround(after_, target);
        if (likely_after_.triangles().empty())
            addNeighboursInOrder(t);
        const float total = carried + nearest_.bound(cornersBefore(t), index_after_,
                                                     likely_after_.triangles(), tolerance(carried));
        for (const uint32_t triangle : nearest_.used())
            raiseError(triangle, total);
        worst_ = std::max(worst_, total);
    }

    void searchAfter(uint32_t t)
    {
        float carried = 0;
        likely_before_.clear();
        const size_t source = simplified_.source_triangle[t];
        for (size_t corner = source * 3; corner < source * 3 + 3; ++corner)
            if (moved(corner) != 0)
                likely_before_.addAround(map_.oppositesBefore(), static_cast<uint32_t>(corner));
        for (const uint32_t triangle : likely_before_.triangles())
            carried = std::max(carried, group_.errors[triangle]);
        const float distance = nearest_.bound(after_.triangleCorners(t), index_before_,
                                              likely_before_.triangles(), tolerance(carried));
        carried = 0;
        for (const uint32_t triangle : nearest_.used())
            carried = std::max(carried, group_.errors[triangle]);
        raiseError(t, carried + distance);
        worst_ = std::max(worst_, carried + distance);
    }

    /// Return the tolerance of a search: nothing is gained below the largest total so far.
    Tolerance tolerance(float carried) const { return {worst_ - carried, carried * kSlackOfCarried}; }

    /// Add new triangles that are close to an old one in the clusters' order: a fair guess for islands that
    /// were removed.
    void addNeighboursInOrder(size_t source)
    {
        const auto& left = simplified_.source_triangle;
        const auto after =
            static_cast<size_t>(std::lower_bound(left.begin(), left.end(), source) - left.begin());
        const size_t last_start = left.size() - std::min(left.size(), kNeighbours);
        const size_t start = std::min(after - std::min(after, kNeighbours / 2), last_start);
        for (size_t i = start; i < std::min(start + kNeighbours, left.size()); ++i)
            likely_after_.add(static_cast<uint32_t>(i));
    }

    const GroupMesh& group_;
    const SimplifiedGroup& simplified_;
    const Surface& after_;
    std::vector<uint32_t> positions_before_; ///< three position ids for each triangle
    std::vector<uint8_t> moved_;             ///< for each position: it is not where it was
    std::vector<uint8_t> changed_;           ///< for each triangle before: it was removed or changed
    SurfaceMap map_;
    TriangleBoxes index_before_;
    TriangleBoxes index_after_;
    std::vector<float> sums_; ///< for each triangle after, SurfaceMap::maxSums
    LikelyTriangles likely_before_;
    LikelyTriangles likely_after_;
    NearestBound nearest_;
    float worst_ = 0;           ///< largest total so far, among those that were searched
    std::vector<float> errors_; ///< for each triangle after
};

} // namespace

Deviation boundDeviation(const GroupMesh& group, const SimplifiedGroup& simplified, const Surface& after,
                         std::span<const TrianglePoint> points)
{
    HEARTH_ASSERT(simplified.triangleCount() > 0);
    return DeviationMeasure(group, simplified, after, points).run();
}

} // namespace hearth::clusters
