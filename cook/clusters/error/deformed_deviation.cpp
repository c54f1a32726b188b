// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/error/deformed_deviation.h"

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/islands.h"
#include "cook/clusters/core/triangle_boxes.h"
#include "cook/clusters/surface/nearest_bound.h"
#include "cook/clusters/surface/surface_tree.h"
#include "formats/base/assert.h"

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
struct GroupSurface
{
    CornerSpan<const PositionId> position_ids;
    CornerSpan<const WedgeId> corners;
    IdSpan<PositionId, const Float3> positions;
    DeformedSurface wedges;
    TriangleLists triangles_at;
    TriangleBoxes index;

    size_t triangleCount() const { return position_ids.triangleCount(); }
    IdRange<TriangleId> triangles() const { return position_ids.triangles(); }
    Corners triangleCorners(TriangleId triangle) const
    {
        const auto [a, b, c] = position_ids.triangle(triangle);
        return {positions[a], positions[b], positions[c]};
    }
    DeformedPoint trianglePoint(TriangleId triangle, const std::array<double, 3>& parts) const
    {
        return {&wedges, corners.triangle(triangle), parts};
    }
};

constexpr std::array<double, 3> kMiddle{1.0 / 3, 1.0 / 3, 1.0 / 3};

std::array<double, 3> barycentrics(double v, double w)
{
    return {1 - v - w, v, w};
}

/// Metric between a piece of one triangle and a few triangles of the other surface.
class TriangleMetric final : public SurfaceMetric
{
public:
    TriangleMetric(DeformationMetric& metric, const GroupSurface& from, TriangleId triangle,
                   const GroupSurface& to)
        : metric_(metric), from_(from), triangle_(triangle), to_(to)
    {
    }

    /// Load the candidate triangles. False if no joint bounds the motion of all others.
    bool load(std::span<const TriangleId> triangles) override
    {
        triangles_.assign(triangles.begin(), triangles.end());
        std::vector<DeformedPoint> others;
        for (const TriangleId triangle : triangles)
            others.push_back(to_.trianglePoint(triangle, kMiddle));
        const auto main = metric_.mainJoint(from_.trianglePoint(triangle_, kMiddle), others);
        main_ = main.value_or(0);
        return main.has_value();
    }

    void setPiece(const std::array<Float2, 3>& corners) override { piece_ = corners; }

    Lanes distance2(Float2 plane, size_t block, const TriangleBlock::Nearest& nearest) const override
    {
        const Float2 at = piece_[0] + (piece_[1] - piece_[0]) * plane.x + (piece_[2] - piece_[0]) * plane.y;
        const DeformedPoint point = from_.trianglePoint(
            triangle_, barycentrics(static_cast<double>(at.x), static_cast<double>(at.y)));
        Lanes squares;
        for (size_t lane = 0; lane < kLanes; ++lane)
        {
            const size_t i = block * kLanes + lane;
            const auto parts =
                barycentrics(static_cast<double>(nearest.v[lane]), static_cast<double>(nearest.w[lane]));
            const double distance = metric_.between(
                point, to_.trianglePoint(triangles_[i < triangles_.size() ? i : 0], parts), main_);
            squares[lane] = static_cast<float>(distance * distance);
        }
        return squares;
    }

private:
    DeformationMetric& metric_;
    const GroupSurface& from_;
    TriangleId triangle_;
    const GroupSurface& to_;
    std::array<Float2, 3> piece_{Float2{0, 0}, Float2{1, 0}, Float2{0, 1}};
    std::vector<TriangleId> triangles_;
    uint32_t main_ = 0; ///< joint
};

/// Triangle to compare with the other surface.
struct Task
{
    float moved; ///< largest distance of a corner to its target: the largest bound rules others out
    TriangleId triangle;
    bool before;
};

class DeformedMeasure
{
public:
    DeformedMeasure(const GroupMesh& group, const SimplifiedGroup& simplified, const Surface& after,
                    const SimplifiedVertices& vertices, const MeshMotion& motion)
        : group_(group),
          simplified_(simplified),
          positions_before_(gatherPositionIds(group, group.corners)),
          before_{positions_before_,
                  group.corners,
                  group.positions,
                  {},
                  TriangleLists(group.positions.size(), positions_before_),
                  TriangleBoxes(positions_before_, group.positions)},
          after_{after.position_ids,
                 simplified.corners,
                 after.position_of_id,
                 {},
                 TriangleLists(group.positions.size(), after.position_ids),
                 TriangleBoxes(after.position_ids, after.position_of_id)},
          metric_({group.center[0], group.center[1], group.center[2]}, group.scale, motion),
          errors_(after.triangleCount(), 0)
    {
        for (const WedgeId wedge : group.vertex_of_wedge.ids())
        {
            const PositionId position = group.position_id_of_wedge[wedge];
            before_.wedges.add(group.positions[position], vertices.mesh,
                               toIndex(group.vertex_of_wedge[wedge]), group.scale);
            const VertexId vertex = vertices.vertex_of_wedge[wedge];
            const bool made = isNewVertex(vertex);
            after_.wedges.add(after.position_of_id[position], made ? vertices.made : vertices.mesh,
                              made ? newVertexNumber(vertex) : toIndex(vertex), group.scale);
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
    bool sameAsBefore(TriangleId triangle) const
    {
        const std::array<WedgeId, 3> wedges = simplified_.corners.triangle(triangle);
        if (wedges != group_.corners.triangle(simplified_.source_triangle[triangle]))
            return false;
        return std::none_of(
            wedges.begin(), wedges.end(),
            [&](WedgeId wedge)
            { return simplified_.placement.modified[group_.position_id_of_wedge[wedge]] != 0; });
    }

    PositionId targetPosition(PositionId position) const { return simplified_.target_of_position[position]; }

    float maxDisplacement(const GroupSurface& side, TriangleId triangle) const
    {
        float farthest = 0;
        for (const PositionId position : side.position_ids.triangle(triangle))
        {
            const PositionId target = targetPosition(position);
            if (target != kPruned)
                farthest = std::max(farthest, length(after_.positions[target] - before_.positions[position]));
        }
        return farthest;
    }

    /// Keep the errors of unchanged triangles, and return the others as tasks, those that moved farthest
    /// first.
    std::vector<Task> findTasks()
    {
        IdVector<TriangleId, uint8_t> kept(before_.triangleCount(), 0);
        std::vector<Task> tasks;
        for (const TriangleId t : after_.triangles())
        {
            const TriangleId source = simplified_.source_triangle[t];
            if (sameAsBefore(t))
            {
                kept[source] = 1;
                errors_[t] = group_.errors[source];
            }
            else
                tasks.push_back({maxDisplacement(after_, t), t, false});
        }
        for (const TriangleId t : before_.triangles())
            if (kept[t] == 0)
                tasks.push_back({maxDisplacement(before_, t), t, true});
        std::stable_sort(tasks.begin(), tasks.end(),
                         [](const Task& a, const Task& b) { return a.moved > b.moved; });
        return tasks;
    }

    void measureBefore(TriangleId t)
    {
        likely_.clear();
        for (const PositionId position : positions_before_.triangle(t))
            if (const PositionId target = targetPosition(position); target != kPruned)
                addLikely(after_.triangles_at.list(target));
        const float carried = group_.errors[t];
        const float total = carried + bound(before_, t, after_, carried);
        worst_ = std::max(worst_, total);
        for (const TriangleId triangle : used_)
            errors_[triangle] = std::max(errors_[triangle], total);
    }

    void measureAfter(TriangleId t)
    {
        likely_.clear();
        for (const PositionId position : positions_before_.triangle(simplified_.source_triangle[t]))
            addLikely(before_.triangles_at.list(position));
        float carried = 0;
        for (const TriangleId triangle : likely_)
            carried = std::max(carried, group_.errors[triangle]);
        const float distance = bound(after_, t, before_, carried);
        carried = 0;
        for (const TriangleId triangle : used_)
            carried = std::max(carried, group_.errors[triangle]);
        errors_[t] = std::max(errors_[t], carried + distance);
        worst_ = std::max(worst_, carried + distance);
    }

    void addLikely(std::span<const TriangleId> triangles)
    {
        for (const TriangleId triangle : triangles)
            if (likely_.size() < kMaxPosedLikely &&
                std::find(likely_.begin(), likely_.end(), triangle) == likely_.end())
                likely_.push_back(triangle);
    }

    /// Bound the distance of any point of the triangle to the other surface. Leaves the triangles that the
    /// bound was taken from in used_.
    float bound(const GroupSurface& from, TriangleId triangle, GroupSurface& to, float carried)
    {
        TriangleMetric metric(metric_, from, triangle, to);
        const Tolerance tolerance{worst_ - carried, carried * kPosedCarriedSlack};
        const float distance =
            nearest_.bound(from.triangleCorners(triangle), to.index, likely_, tolerance, &metric);
        used_.clear();
        for (const NearestBound::UsedTriangle& used : nearest_.used())
            used_.push_back(used.triangle);
        return distance;
    }

    const GroupMesh& group_;
    const SimplifiedGroup& simplified_;
    CornerVector<PositionId> positions_before_;
    GroupSurface before_;
    GroupSurface after_;
    DeformationMetric metric_;
    NearestBound nearest_;
    std::vector<TriangleId> likely_; ///< triangles of the other surface, each once
    std::vector<TriangleId> used_;
    float worst_ = 0;                    ///< largest total up to now
    IdVector<TriangleId, float> errors_; ///< for each triangle after
};

} // namespace

Deviation boundDeformedDeviation(const GroupMesh& group, const SimplifiedGroup& simplified,
                                 const Surface& after, const SimplifiedVertices& vertices,
                                 const MeshMotion& motion)
{
    HEARTH_ASSERT(simplified.triangleCount() > 0 && after.triangleCount() == simplified.triangleCount());
    HEARTH_ASSERT(vertices.vertex_of_wedge.size() == group.vertex_of_wedge.size());
    Deviation deviation = DeformedMeasure(group, simplified, after, vertices, motion).run();
    HEARTH_ASSERT(deviation.errors.size() == after.triangleCount());
    return deviation;
}

namespace
{

/// Bound the distance of the triangles of one surface to the other one.
///
/// tree  of `to`
double oneSidedDistance(const GroupSurface& from, const GroupSurface& to, const SurfaceTree& tree,
                        DeformationMetric& metric)
{
    PieceBounder bounder;
    Candidates candidates;
    std::vector<TriangleId> triangles;
    std::vector<DistanceTriangle> loaded;
    double worst = 0;
    TriangleId hint{};
    for (const TriangleId t : from.triangles())
    {
        const Corners c = from.triangleCorners(t);
        triangles.clear();
        loaded.clear();
        for (const Float3 point : {c[0], c[1], c[2], (c[0] + c[1]) * 0.5f, (c[1] + c[2]) * 0.5f,
                                   (c[2] + c[0]) * 0.5f, triangleCenter(c[0], c[1], c[2])})
        {
            hint = tree.nearest(widen(point), 0, hint).triangle;
            if (std::find(triangles.begin(), triangles.end(), hint) != triangles.end())
                continue;
            triangles.push_back(hint);
            loaded.push_back(to.index.triangle(hint));
        }
        TriangleMetric by(metric, from, t, to);
        if (!by.load(triangles))
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

double boundDeformedSurfaces(const PreparedMesh& mesh, CornerSpan<const VertexId> source,
                             CornerSpan<const VertexId> level)
{
    HEARTH_ASSERT(!source.empty() && !level.empty());
    HEARTH_ASSERT(allBelow(source, mesh.vertices.vertexCount()) &&
                  allBelow(level, mesh.vertices.vertexCount()));
    const mesh::SourceMesh& vertices = mesh.vertices;
    DeformedSurface surface;
    for (uint32_t v = 0; v < vertices.vertexCount(); ++v)
        surface.add(vertices.positions[v], vertices, v, 1);
    // each vertex is a wedge with a position of its own
    struct SurfaceCorners
    {
        CornerVector<PositionId> positions;
        CornerVector<WedgeId> wedges;
    };
    const auto convert = [](CornerSpan<const VertexId> corners)
    {
        return SurfaceCorners{CornerVector<PositionId>(convertIds<PositionId>(corners)),
                              CornerVector<WedgeId>(convertIds<WedgeId>(corners))};
    };
    const IdSpan<PositionId, const Float3> positions{std::span(vertices.positions)};
    const auto makeSurface = [&](const SurfaceCorners& corners)
    {
        return GroupSurface{corners.positions,
                            corners.wedges,
                            positions,
                            surface,
                            {},
                            TriangleBoxes(corners.positions, positions)};
    };
    const SurfaceCorners source_corners = convert(source), level_corners = convert(level);
    const GroupSurface of_source = makeSurface(source_corners), of_level = makeSurface(level_corners);
    const SurfaceTree source_tree({mesh.positions(), source}), level_tree({mesh.positions(), level});
    DeformationMetric metric({}, 1, meshMotion(mesh));
    return std::max(oneSidedDistance(of_source, of_level, level_tree, metric),
                    oneSidedDistance(of_level, of_source, source_tree, metric));
}

const MeshMotion& meshMotion(const PreparedMesh& mesh)
{
    static const MeshMotion none;
    return mesh.motion != nullptr ? *mesh.motion : none;
}

} // namespace hearth::clusters
