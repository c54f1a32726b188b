// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/error/deformed_deviation.h"

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/facet_index.h"
#include "cook/clusters/core/islands.h"
#include "cook/clusters/surface/nearest_bound.h"
#include "cook/clusters/surface/surface_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hearth::clusters
{

namespace
{

// Rounding of a distance between points in [-1, 1]^3, of positions and of weights: a few times 2^-23, with
// margin.
constexpr float kPosedRounding = 4e-6f;

// As in boundDeviation: size of a list of likely triangles, and slack on an error that is carried on.
constexpr size_t kMaxPosedLikely = 5 * kLanes;
constexpr float kPosedCarriedSlack = kSlack - 1;

/// Surface before or after the simplification.
struct Side
{
    std::span<const uint32_t> positions; ///< position ids, three for each triangle
    std::span<const uint32_t> wedges;    ///< three for each triangle
    std::span<const Float3> places;      ///< position of each position id
    DeformedSurface vertices;            ///< by wedge
    NumberLists facets_at;               ///< triangles at each position
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

/// Metric between a piece of one triangle and a few triangles of the other surface.
class FacetMetric final : public SurfaceMetric
{
public:
    FacetMetric(DeformationMetric& metric, const Side& from, size_t triangle, const Side& to)
        : metric_(metric), from_(from), triangle_(triangle), to_(to)
    {
    }

    /// Load the candidate triangles. False if no joint bounds the motion of all others.
    bool load(std::span<const uint32_t> facets) override
    {
        facets_.assign(facets.begin(), facets.end());
        std::vector<DeformedPoint> others;
        for (const uint32_t facet : facets)
            others.push_back(to_.pointOf(facet, kMiddle));
        const auto main = metric_.mainJoint(from_.pointOf(triangle_, kMiddle), others);
        main_ = main.value_or(0);
        return main.has_value();
    }

    void setPiece(const std::array<Float2, 3>& corners) override { piece_ = corners; }

    Lanes distance2(Float2 plane, size_t block, const FacetBlock::Nearest& nearest) const override
    {
        const Float2 at = piece_[0] + (piece_[1] - piece_[0]) * plane.x + (piece_[2] - piece_[0]) * plane.y;
        const DeformedPoint point =
            from_.pointOf(triangle_, partsOf(static_cast<double>(at.x), static_cast<double>(at.y)));
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
    std::array<Float2, 3> piece_{Float2{0, 0}, Float2{1, 0}, Float2{0, 1}};
    std::vector<uint32_t> facets_;
    uint32_t main_ = 0;
};

/// Triangle to compare with the other surface.
struct Task
{
    float moved; ///< largest distance of a corner to its target: the largest bound rules others out
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
          metric_({group.center[0], group.center[1], group.center[2]}, group.scale, motion),
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
            error += error > 0 ? kPosedRounding : 0.0f;
        return {std::move(errors_), nearest_.loosePieces()};
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

    /// Keep the errors of unchanged triangles, and return the others as tasks, those that moved farthest
    /// first.
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
        const float total = carried + bound(before_, t, after_, carried);
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
        const float distance = bound(after_, t, before_, carried);
        carried = 0;
        for (const uint32_t facet : served_)
            carried = std::max(carried, group_.errors[facet]);
        errors_[t] = std::max(errors_[t], carried + distance);
        worst_ = std::max(worst_, carried + distance);
    }

    void addLikely(std::span<const uint32_t> facets)
    {
        for (const uint32_t facet : facets)
            if (likely_.size() < kMaxPosedLikely &&
                std::find(likely_.begin(), likely_.end(), facet) == likely_.end())
                likely_.push_back(facet);
    }

    /// Bound the distance of any point of the triangle to the other surface. Leaves the triangles that the
    /// bound was taken from in served_.
    float bound(const Side& from, uint32_t triangle, Side& to, float carried)
    {
        FacetMetric metric(metric_, from, triangle, to);
        const Allowance allowance{worst_ - carried, carried * kPosedCarriedSlack};
        const float distance =
            nearest_.bound(from.cornersOf(triangle), to.index, likely_, allowance, &metric);
        served_.assign(nearest_.used().begin(), nearest_.used().end());
        return distance;
    }

    const GroupMesh& group_;
    const Simplified& simplified_;
    std::vector<uint32_t> positions_before_; ///< three position ids for each triangle
    Side before_;
    Side after_;
    DeformationMetric metric_;
    NearestBound nearest_;
    std::vector<uint32_t> likely_; ///< triangles of the other surface, each once
    std::vector<uint32_t> served_;
    float worst_ = 0;           ///< largest total up to now
    std::vector<float> errors_; ///< for each triangle after
};

} // namespace

Deviation boundDeformedDeviation(const GroupMesh& group, const Simplified& simplified, const Surface& after,
                                 const SimplifiedVertices& vertices, const MeshMotion& motion)
{
    HEARTH_ASSERT(simplified.triangleCount() > 0);
    return DeformedMeasure(group, simplified, after, vertices, motion).run();
}

namespace
{

/// Bound the distance of the triangles of one surface to the other one.
double oneWay(const Side& from, const Side& to, DeformationMetric& metric)
{
    const SurfaceTree tree({to.places, to.positions});
    Bounder bounder;
    Candidates candidates;
    std::vector<uint32_t> facets;
    std::vector<Facet> loaded;
    double worst = 0;
    uint32_t hint = 0;
    for (size_t t = 0; t < from.facetCount(); ++t)
    {
        const Corners c = from.cornersOf(t);
        facets.clear();
        loaded.clear();
        for (const Float3 point : {c[0], c[1], c[2], (c[0] + c[1]) * 0.5f, (c[1] + c[2]) * 0.5f,
                                   (c[2] + c[0]) * 0.5f, triangleCenter(c[0], c[1], c[2])})
        {
            hint = tree.nearest(widen(point), 0, hint).triangle;
            if (std::find(facets.begin(), facets.end(), hint) != facets.end())
                continue;
            facets.push_back(hint);
            loaded.push_back(to.index.facet(hint));
        }
        FacetMetric by(metric, from, t, to);
        if (!by.load(facets))
            return std::numeric_limits<double>::infinity();
        candidates.load(loaded);
        const auto enough = static_cast<float>(worst * worst);
        const Bound bound = bounder.bound(c, candidates.blocks(), enough,
                                          std::numeric_limits<float>::infinity(), kMaxPoints, &by);
        worst = std::max(worst, std::sqrt(static_cast<double>(bound.upper2)));
    }
    return worst;
}

} // namespace

double boundDeformedSurfaces(const PreparedMesh& mesh, std::span<const uint32_t> source,
                             std::span<const uint32_t> level)
{
    HEARTH_ASSERT(!source.empty() && !level.empty());
    const mesh::SourceMesh& vertices = mesh.vertices;
    DeformedSurface surface;
    for (uint32_t v = 0; v < vertices.vertexCount(); ++v)
        surface.add(vertices.positions[v], vertices, v, 1);
    const auto sideOf = [&](std::span<const uint32_t> corners) {
        return Side{corners, corners, vertices.positions,
                    surface, {},      FacetIndex(corners, vertices.positions)};
    };
    const Side of_source = sideOf(source), of_level = sideOf(level);
    DeformationMetric metric({}, 1, motionOf(mesh));
    return std::max(oneWay(of_source, of_level, metric), oneWay(of_level, of_source, metric));
}

const MeshMotion& motionOf(const PreparedMesh& mesh)
{
    static const MeshMotion none;
    return mesh.motion != nullptr ? *mesh.motion : none;
}

} // namespace hearth::clusters
