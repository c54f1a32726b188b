// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/error/deformed_deviation.h"

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/islands.h"
#include "cook/clusters/core/triangle_boxes.h"
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
struct GroupSurface
{
    std::span<const uint32_t> position_ids; ///< position ids, three for each triangle
    std::span<const uint32_t> wedges;       ///< three for each triangle
    std::span<const Float3> positions;      ///< position of each position id
    DeformedSurface vertices;               ///< by wedge
    IndexLists triangles_at;                ///< triangles at each position
    TriangleBoxes index;

    size_t triangleCount() const { return position_ids.size() / 3; }
    Corners triangleCorners(size_t triangle) const
    {
        return {positions[position_ids[triangle * 3]], positions[position_ids[triangle * 3 + 1]],
                positions[position_ids[triangle * 3 + 2]]};
    }
    DeformedPoint trianglePoint(size_t triangle, const std::array<double, 3>& parts) const
    {
        return {&vertices, {wedges[triangle * 3], wedges[triangle * 3 + 1], wedges[triangle * 3 + 2]}, parts};
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
    TriangleMetric(DeformationMetric& metric, const GroupSurface& from, size_t triangle,
                   const GroupSurface& to)
        : metric_(metric), from_(from), triangle_(triangle), to_(to)
    {
    }

    /// Load the candidate triangles. False if no joint bounds the motion of all others.
    bool load(std::span<const uint32_t> triangles) override
    {
        triangles_.assign(triangles.begin(), triangles.end());
        std::vector<DeformedPoint> others;
        for (const uint32_t triangle : triangles)
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
    size_t triangle_;
    const GroupSurface& to_;
    std::array<Float2, 3> piece_{Float2{0, 0}, Float2{1, 0}, Float2{0, 1}};
    std::vector<uint32_t> triangles_;
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
    DeformedMeasure(const GroupMesh& group, const SimplifiedGroup& simplified, const Surface& after,
                    const SimplifiedVertices& vertices, const MeshMotion& motion)
        : group_(group),
          simplified_(simplified),
          positions_before_(gatherPositionIds(group, group.corners)),
          before_{positions_before_,
                  group.corners,
                  group.positions,
                  {},
                  IndexLists::byKey<3>(group.positions.size(), positions_before_),
                  TriangleBoxes(positions_before_, group.positions)},
          after_{after.position_ids,
                 simplified.corners,
                 after.position_of_id,
                 {},
                 IndexLists::byKey<3>(group.positions.size(), after.position_ids),
                 TriangleBoxes(after.position_ids, after.position_of_id)},
          metric_({group.center[0], group.center[1], group.center[2]}, group.scale, motion),
          errors_(after.triangleCount(), 0)
    {
        for (size_t wedge = 0; wedge < group.vertex_of_wedge.size(); ++wedge)
        {
            const uint32_t position = group.position_id_of_wedge[wedge];
            before_.vertices.add(group.positions[position], vertices.mesh, group.vertex_of_wedge[wedge],
                                 group.scale);
            const uint32_t vertex = vertices.vertex_of_wedge[wedge];
            const bool made = vertex >= kFirstNewVertex;
            after_.vertices.add(after.position_of_id[position], made ? vertices.made : vertices.mesh,
                                made ? vertex - kFirstNewVertex : vertex, group.scale);
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
                simplified_.placement.modified[group_.position_id_of_wedge[wedge]] != 0)
                return false;
        }
        return true;
    }

    uint32_t targetPosition(uint32_t position) const { return simplified_.target_of_position[position]; }

    float maxDisplacement(const GroupSurface& side, size_t triangle) const
    {
        float farthest = 0;
        for (size_t corner = triangle * 3; corner < triangle * 3 + 3; ++corner)
        {
            const uint32_t position = side.position_ids[corner];
            const uint32_t target = targetPosition(position);
            if (target != kPruned)
                farthest = std::max(farthest, length(after_.positions[target] - before_.positions[position]));
        }
        return farthest;
    }

    /// Keep the errors of unchanged triangles, and return the others as tasks, those that moved farthest
    /// first.
    std::vector<Task> findTasks()
    {
        std::vector<uint8_t> kept(before_.triangleCount(), 0);
        std::vector<Task> tasks;
        for (uint32_t t = 0; t < after_.triangleCount(); ++t)
        {
            const uint32_t source = simplified_.source_triangle[t];
            if (sameAsBefore(t))
            {
                kept[source] = 1;
                errors_[t] = group_.errors[source];
            }
            else
                tasks.push_back({maxDisplacement(after_, t), t, false});
        }
        for (uint32_t t = 0; t < before_.triangleCount(); ++t)
            if (kept[t] == 0)
                tasks.push_back({maxDisplacement(before_, t), t, true});
        std::stable_sort(tasks.begin(), tasks.end(),
                         [](const Task& a, const Task& b) { return a.moved > b.moved; });
        return tasks;
    }

    void measureBefore(uint32_t t)
    {
        likely_.clear();
        for (size_t corner = size_t{t} * 3; corner < size_t{t} * 3 + 3; ++corner)
            if (const uint32_t target = targetPosition(positions_before_[corner]); target != kPruned)
                addLikely(after_.triangles_at.list(target));
        const float carried = group_.errors[t];
        const float total = carried + bound(before_, t, after_, carried);
        worst_ = std::max(worst_, total);
        for (const uint32_t triangle : used_)
            errors_[triangle] = std::max(errors_[triangle], total);
    }

    void measureAfter(uint32_t t)
    {
        likely_.clear();
        const size_t source = simplified_.source_triangle[t];
        for (size_t corner = source * 3; corner < source * 3 + 3; ++corner)
            addLikely(before_.triangles_at.list(positions_before_[corner]));
        float carried = 0;
        for (const uint32_t triangle : likely_)
            carried = std::max(carried, group_.errors[triangle]);
        const float distance = bound(after_, t, before_, carried);
        carried = 0;
        for (const uint32_t triangle : used_)
            carried = std::max(carried, group_.errors[triangle]);
        errors_[t] = std::max(errors_[t], carried + distance);
        worst_ = std::max(worst_, carried + distance);
    }

    void addLikely(std::span<const uint32_t> triangles)
    {
        for (const uint32_t triangle : triangles)
            if (likely_.size() < kMaxPosedLikely &&
                std::find(likely_.begin(), likely_.end(), triangle) == likely_.end())
                likely_.push_back(triangle);
    }

    /// Bound the distance of any point of the triangle to the other surface. Leaves the triangles that the
    /// bound was taken from in used_.
    float bound(const GroupSurface& from, uint32_t triangle, GroupSurface& to, float carried)
    {
        TriangleMetric metric(metric_, from, triangle, to);
        const Tolerance tolerance{worst_ - carried, carried * kPosedCarriedSlack};
        const float distance =
            nearest_.bound(from.triangleCorners(triangle), to.index, likely_, tolerance, &metric);
        used_.assign(nearest_.used().begin(), nearest_.used().end());
        return distance;
    }

    const GroupMesh& group_;
    const SimplifiedGroup& simplified_;
    std::vector<uint32_t> positions_before_; ///< three position ids for each triangle
    GroupSurface before_;
    GroupSurface after_;
    DeformationMetric metric_;
    NearestBound nearest_;
    std::vector<uint32_t> likely_; ///< triangles of the other surface, each once
    std::vector<uint32_t> used_;
    float worst_ = 0;           ///< largest total up to now
    std::vector<float> errors_; ///< for each triangle after
};

} // namespace

Deviation boundDeformedDeviation(const GroupMesh& group, const SimplifiedGroup& simplified,
                                 const Surface& after, const SimplifiedVertices& vertices,
                                 const MeshMotion& motion)
{
    HEARTH_ASSERT(simplified.triangleCount() > 0);
    return DeformedMeasure(group, simplified, after, vertices, motion).run();
}

namespace
{

/// Bound the distance of the triangles of one surface to the other one.
double oneSidedDistance(const GroupSurface& from, const GroupSurface& to, DeformationMetric& metric)
{
    const SurfaceTree tree({to.positions, to.position_ids});
    PieceBounder bounder;
    Candidates candidates;
    std::vector<uint32_t> triangles;
    std::vector<DistanceTriangle> loaded;
    double worst = 0;
    uint32_t hint = 0;
    for (size_t t = 0; t < from.triangleCount(); ++t)
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

double boundDeformedSurfaces(const PreparedMesh& mesh, std::span<const uint32_t> source,
                             std::span<const uint32_t> level)
{
    HEARTH_ASSERT(!source.empty() && !level.empty());
    const mesh::SourceMesh& vertices = mesh.vertices;
    DeformedSurface surface;
    for (uint32_t v = 0; v < vertices.vertexCount(); ++v)
        surface.add(vertices.positions[v], vertices, v, 1);
    const auto makeSurface = [&](std::span<const uint32_t> corners)
    {
        return GroupSurface{corners, corners, vertices.positions,
                            surface, {},      TriangleBoxes(corners, vertices.positions)};
    };
    const GroupSurface of_source = makeSurface(source), of_level = makeSurface(level);
    DeformationMetric metric({}, 1, meshMotion(mesh));
    return std::max(oneSidedDistance(of_source, of_level, metric),
                    oneSidedDistance(of_level, of_source, metric));
}

const MeshMotion& meshMotion(const PreparedMesh& mesh)
{
    static const MeshMotion none;
    return mesh.motion != nullptr ? *mesh.motion : none;
}

} // namespace hearth::clusters
