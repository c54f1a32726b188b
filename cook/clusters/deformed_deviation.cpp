// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/deformed_deviation.h"

#include "cook/clusters/facet_index.h"
#include "cook/clusters/islands.h"
#include "cook/clusters/reduce.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hearth::clusters
{

namespace
{

// Rounding of a distance between points in [-1, 1]^3, of places and of weights: a few times 2^-23, with room.
constexpr float kRounding = 4e-6f;

// The first try takes few facets and few points, the second one these.
constexpr size_t kFew = 2 * kLanes;
constexpr size_t kFewPoints = 6;
constexpr size_t kMany = 6 * kLanes;

// Facets within this part of a triangle's size are looked at first.
constexpr float kTouching = 0.1f;

/// One of the two surfaces.
struct Side
{
    std::span<const uint32_t> positions; ///< three for each facet
    std::span<const uint32_t> wedges;    ///< the same
    std::span<const Float3> places;      ///< of positions
    DeformedSurface vertices;            ///< by wedge
    NumberLists facets_at;               ///< facets at each position
    FacetIndex index;

    size_t facetCount() const { return positions.size() / 3; }
    Corners cornersOf(size_t facet) const
    {
        return {places[positions[facet * 3]], places[positions[facet * 3 + 1]],
                places[positions[facet * 3 + 2]]};
    }
    DeformedPoint pointOf(size_t facet, const std::array<double, 3>& parts) const
    {
        return {&vertices, {wedges[facet * 3], wedges[facet * 3 + 1], wedges[facet * 3 + 2]}, parts};
    }
};

constexpr std::array<double, 3> kMiddle{1.0 / 3, 1.0 / 3, 1.0 / 3};

std::array<double, 3> partsOf(double v, double w)
{
    return {1 - v - w, v, w};
}

/// The metric between a piece of one triangle and a few facets of the other surface.
class FacetMetric final : public PointMetric
{
public:
    FacetMetric(DeformationMetric& metric, const Side& from, size_t triangle, const Side& to)
        : metric_(metric), from_(from), triangle_(triangle), to_(to)
    {
    }

    /// False where no joint bounds the motion of all others.
    bool load(std::span<const uint32_t> facets)
    {
        facets_ = facets;
        std::vector<DeformedPoint> others;
        for (const uint32_t facet : facets)
            others.push_back(to_.pointOf(facet, kMiddle));
        const auto main = metric_.mainJoint(from_.pointOf(triangle_, kMiddle), others);
        main_ = main.value_or(0);
        return main.has_value();
    }

    Lanes distance2(Float2 plane, size_t block, const FacetBlock::Nearest& nearest) const override
    {
        const DeformedPoint point =
            from_.pointOf(triangle_, partsOf(static_cast<double>(plane.x), static_cast<double>(plane.y)));
        Lanes squares;
        for (size_t lane = 0; lane < kLanes; ++lane)
        {
            const size_t i = block * kLanes + lane;
            const auto parts =
                partsOf(static_cast<double>(nearest.v[lane]), static_cast<double>(nearest.w[lane]));
            const double distance =
                metric_.between(point, to_.pointOf(facets_[i < facets_.size() ? i : 0], parts), main_);
            squares[lane] = static_cast<float>(distance * distance);
        }
        return squares;
    }

private:
    DeformationMetric& metric_;
    const Side& from_;
    size_t triangle_;
    const Side& to_;
    std::span<const uint32_t> facets_;
    uint32_t main_ = 0;
};

/// A triangle that is held against the other surface.
struct Task
{
    float moved; ///< how far its farthest corner lies from where it went: the largest bound rules others out
    uint32_t triangle;
    bool before;
};

class DeformedMeasure
{
public:
    DeformedMeasure(const GroupMesh& group, const Simplified& simplified, const Surface& after,
                    const SimplifiedVertices& vertices, const MeshMotion& motion)
        : group_(group),
          simplified_(simplified),
          positions_before_(positionsOfCorners(group, group.corners)),
          before_{positions_before_,
                  group.corners,
                  group.positions,
                  {},
                  NumberLists::byKey<3>(group.positions.size(), positions_before_),
                  FacetIndex(positions_before_, group.positions)},
          after_{after.positions,
                 simplified.corners,
                 after.place_of_position,
                 {},
                 NumberLists::byKey<3>(group.positions.size(), after.positions),
                 FacetIndex(after.positions, after.place_of_position)},
          metric_(group, motion),
          errors_(after.facetCount(), 0)
    {
        for (size_t wedge = 0; wedge < group.vertex_of_wedge.size(); ++wedge)
        {
            const uint32_t position = group.position_of_wedge[wedge];
            before_.vertices.add(group.positions[position], vertices.mesh, group.vertex_of_wedge[wedge],
                                 group.scale);
            const uint32_t vertex = vertices.vertex_of_wedge[wedge];
            const bool made = vertex >= kMadeVertex;
            after_.vertices.add(after.place_of_position[position], made ? vertices.made : vertices.mesh,
                                made ? vertex - kMadeVertex : vertex, group.scale);
        }
    }

    Deviation run()
    {
        for (const Task& task : findTasks())
            task.before ? measureBefore(task.triangle) : measureAfter(task.triangle);
        for (float& error : errors_)
            error += error > 0 ? kRounding : 0.0f;
        return {std::move(errors_), loose_};
    }

private:
    bool sameAsBefore(size_t triangle) const
    {
        const size_t source = simplified_.source_triangle[triangle];
        for (size_t k = 0; k < 3; ++k)
        {
            const uint32_t wedge = simplified_.corners[triangle * 3 + k];
            if (wedge != group_.corners[source * 3 + k] ||
                simplified_.placement.remade[group_.position_of_wedge[wedge]] != 0)
                return false;
        }
        return true;
    }

    uint32_t targetOf(uint32_t position) const { return simplified_.target_of_position[position]; }

    float movedFar(const Side& side, size_t triangle) const
    {
        float far = 0;
        for (size_t corner = triangle * 3; corner < triangle * 3 + 3; ++corner)
        {
            const uint32_t position = side.positions[corner];
            const uint32_t target = targetOf(position);
            if (target != kPruned)
                far = std::max(far, length(after_.places[target] - before_.places[position]));
        }
        return far;
    }

    /// What is as it was keeps its error; all others are to be measured, those that moved farthest first.
    std::vector<Task> findTasks()
    {
        std::vector<uint8_t> kept(before_.facetCount(), 0);
        std::vector<Task> tasks;
        for (uint32_t t = 0; t < after_.facetCount(); ++t)
        {
            const uint32_t source = simplified_.source_triangle[t];
            if (sameAsBefore(t))
            {
                kept[source] = 1;
                errors_[t] = group_.errors[source];
            }
            else
                tasks.push_back({movedFar(after_, t), t, false});
        }
        for (uint32_t t = 0; t < before_.facetCount(); ++t)
            if (kept[t] == 0)
                tasks.push_back({movedFar(before_, t), t, true});
        std::stable_sort(tasks.begin(), tasks.end(),
                         [](const Task& a, const Task& b) { return a.moved > b.moved; });
        return tasks;
    }

    void measureBefore(uint32_t t)
    {
        likely_.clear();
        for (size_t corner = size_t{t} * 3; corner < size_t{t} * 3 + 3; ++corner)
            if (const uint32_t target = targetOf(positions_before_[corner]); target != kPruned)
                addLikely(after_.facets_at.of(target));
        const float carried = group_.errors[t];
        const float total = carried + bound(before_, t, after_, worst_ - carried);
        worst_ = std::max(worst_, total);
        for (const uint32_t facet : served_)
            errors_[facet] = std::max(errors_[facet], total);
    }

    void measureAfter(uint32_t t)
    {
        likely_.clear();
        const size_t source = simplified_.source_triangle[t];
        for (size_t corner = source * 3; corner < source * 3 + 3; ++corner)
            addLikely(before_.facets_at.of(positions_before_[corner]));
        float carried = 0;
        for (const uint32_t facet : likely_)
            carried = std::max(carried, group_.errors[facet]);
        const float distance = bound(after_, t, before_, worst_ - carried);
        carried = 0;
        for (const uint32_t facet : served_)
            carried = std::max(carried, group_.errors[facet]);
        errors_[t] = std::max(errors_[t], carried + distance);
        worst_ = std::max(worst_, carried + distance);
    }

    void addLikely(std::span<const uint32_t> facets)
    {
        for (const uint32_t facet : facets)
            if (likely_.size() < kMany && std::find(likely_.begin(), likely_.end(), facet) == likely_.end())
                likely_.push_back(facet);
    }

    /// How far any point of the triangle can come from the other surface. Leaves the facets that serve in served_.
    float bound(const Side& from, uint32_t triangle, Side& to, float enough)
    {
        const float enough2 = enough > 0 ? enough * enough : 0.0f;
        sortLikely(from.cornersOf(triangle), to);
        if (!likely_.empty())
        {
            const auto few = std::span(likely_).first(std::min(likely_.size(), kFew));
            if (const Bound quick = boundBy(from, triangle, to, few, enough2, kFewPoints); quick.closed)
                return std::sqrt(quick.upper2);
        }
        addNear(from.cornersOf(triangle), to);
        sortLikely(from.cornersOf(triangle), to);
        const Bound found = boundBy(from, triangle, to, likely_, enough2, kMaxPoints);
        loose_ += found.closed ? 0 : 1;
        return std::sqrt(found.upper2);
    }

    Bound boundBy(const Side& from, uint32_t triangle, const Side& to, std::span<const uint32_t> facets,
                  float enough2, size_t most_points)
    {
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        FacetMetric metric(metric_, from, triangle, to);
        served_.assign(facets.begin(), facets.end());
        if (!metric.load(facets))
            return {kInfinity, 0, 0, false};
        facets_.clear();
        for (const uint32_t facet : facets)
            facets_.push_back(to.index.facet(facet));
        candidates_.load(facets_);
        const Bound bound = bounder_.bound(from.cornersOf(triangle), candidates_.blocks(), enough2, kInfinity,
                                           most_points, &metric);
        served_.clear();
        for (size_t i = 0; i < facets.size(); ++i)
            if (bounder_.hasServed(i))
                served_.push_back(facets[i]);
        return bound;
    }

    /// The nearest ones first, as they are bound.
    void sortLikely(const Corners& corners, const Side& to)
    {
        const Float3 middle = triangleCenter(corners[0], corners[1], corners[2]);
        std::vector<std::pair<float, uint32_t>> by_distance;
        for (const uint32_t facet : likely_)
        {
            const Facet f = to.index.facet(facet);
            by_distance.push_back({makeBlock({&f, &f, &f, &f}).distance2(middle)[0], facet});
        }
        std::sort(by_distance.begin(), by_distance.end());
        for (size_t i = 0; i < likely_.size(); ++i)
            likely_[i] = by_distance[i].second;
    }

    /// Facets around the triangle, from a radius on in which there are some.
    void addNear(const Corners& corners, Side& to)
    {
        Box3 box;
        for (const Float3 corner : corners)
            box.add(corner);
        const Float3 extent = box.max - box.min;
        float radius = std::max(kTouching * std::max({extent.x, extent.y, extent.z}), 1e-3f);
        for (found_.clear(); found_.empty(); radius *= 2)
        {
            const Float3 margin{radius, radius, radius};
            to.index.query({box.min - margin, box.max + margin}, found_);
        }
        std::vector<uint32_t> likely = std::move(likely_);
        likely_.assign(found_.begin(), found_.end());
        sortLikely(corners, to);
        if (likely_.size() > kMany / 2)
            likely_.resize(kMany / 2);
        addLikely(likely);
    }

    const GroupMesh& group_;
    const Simplified& simplified_;
    std::vector<uint32_t> positions_before_; ///< three for each triangle
    Side before_;
    Side after_;
    DeformationMetric metric_;
    Bounder bounder_;
    Candidates candidates_;
    std::vector<Facet> facets_;
    std::vector<uint32_t> likely_; ///< facets of the other surface, each once
    std::vector<uint32_t> found_;
    std::vector<uint32_t> served_;
    float worst_ = 0;           ///< the largest total so far
    std::vector<float> errors_; ///< for each triangle after
    uint64_t loose_ = 0;
};

} // namespace

Deviation boundDeformedDeviation(const GroupMesh& group, const Simplified& simplified, const Surface& after,
                                 const SimplifiedVertices& vertices, const MeshMotion& motion)
{
    HEARTH_ASSERT(simplified.triangleCount() > 0);
    return DeformedMeasure(group, simplified, after, vertices, motion).run();
}

} // namespace hearth::clusters
