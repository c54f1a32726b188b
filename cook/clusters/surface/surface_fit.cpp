// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/surface_fit.h"

#include "cook/clusters/core/islands.h"
#include "cook/clusters/core/triangle_fan.h"
#include "cook/clusters/simplify/triangle_flip.h"
#include "formats/base/assert.h"

#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace hearth::clusters
{

namespace
{

// The residual at a vertex is a mean over the triangles around it: right where all of them have the same
// residual, too small elsewhere. So steps are longer.
constexpr float kOverrelaxation = 1.3f;

// Tolerance of the foot of a perpendicular, in parts of a triangle's edges.
constexpr float kPerpendicularTolerance = 1e-3f;

class SurfaceFit
{
public:
    SurfaceFit(const GroupMesh& group, SimplifiedGroup& simplified, Surface& after, SurfacePoints& points)
        : group_(group),
          placement_(simplified.placement),
          corners_(simplified.corners),
          after_(after),
          points_(points),
          position_residuals_(group.positions.size()),
          exact_weights_(group.positions.size(), 0),
          exact_distance2_(
              static_cast<float>(group.grid_step * group.grid_step / (group.scale * group.scale))),
          attribute_residuals_(group.attributes.size()),
          attribute_weights_(group.vertex_of_wedge.size(), 0)
    {
    }

    void run()
    {
        for (const TriangleId triangle : points_.of_middle.ids())
            if (points_.of_middle[triangle].triangle != kInvalid)
                addMiddle(triangle);
        for (const WedgeId wedge : attribute_weights_.ids())
        {
            const bool has_residual = attribute_weights_[wedge] > 0;
            const bool modified = placement_.modified[group_.position_id_of_wedge[wedge]] != 0;
            if (has_residual & modified)
                changeAttributes(wedge);
        }
        for (const PositionId position : position_residuals_.ids())
        {
            const bool has_residual = position_residuals_[position][3] > 2 * exact_weights_[position];
            const bool modified = placement_.modified[position] != 0;
            if (has_residual & modified)
                move(position);
        }
        after_.setPositions(placement_.positions);
        for (const PositionId position : points_.of_position.ids())
            measure(points_.of_position[position], position);
        for (const WedgeId wedge : points_.of_wedge.ids())
            measure(points_.of_wedge[wedge], group_.position_id_of_wedge[wedge]);
    }

private:
    /// Distribute the residual between the middle of a triangle and its point on the new surface to the
    /// corners of the triangle there.
    void addMiddle(TriangleId triangle)
    {
        const TrianglePoint& point = points_.of_middle[triangle];
        const std::array<PositionId, 3> positions = after_.position_ids.triangle(point.triangle);
        const auto [a, b, c] = group_.trianglePositions(triangle);
        const Float3 away = triangleCenter(a, b, c) - trianglePosition(point, after_.triangles);
        if (!isPerpendicular(point, away))
            return;
        const float area = length(cross(b - a, c - a));
        const std::array<float, 3> parts = point.parts();
        const Lanes residual = Lanes{away.x, away.y, away.z, 1} * splat(area);
        for (size_t k = 0; k < 3; ++k)
            position_residuals_[positions[k]] += residual * splat(parts[k]);
        if (dot(away, away) <= exact_distance2_)
            for (size_t k = 0; k < 3; ++k)
                exact_weights_[positions[k]] += area * parts[k];
        // at a seam both sides would have to change equally, and the middle may lie on the other side
        if ((points_.on_seam[positions[0]] | points_.on_seam[positions[1]] | points_.on_seam[positions[2]]) ==
            0)
            addAttributes(group_.corners.triangle(triangle), corners_.triangle(point.triangle), parts, area);
    }

    /// True if the line to a point is perpendicular to the triangle. On the rim of the fan it is not: other
    /// triangles may be nearer there.
    bool isPerpendicular(const TrianglePoint& point, Float3 away) const
    {
        const DistanceTriangle& triangle = after_.triangles[point.triangle];
        return std::abs(dot(away, triangle.ab)) <= kPerpendicularTolerance * triangle.ab_ab &&
               std::abs(dot(away, triangle.ac)) <= kPerpendicularTolerance * triangle.ac_ac;
    }

    void addAttributes(const std::array<WedgeId, 3>& before, const std::array<WedgeId, 3>& after,
                       const std::array<float, 3>& parts, float area)
    {
        const uint32_t rows = group_.attribute_rows;
        const Lanes* of_after = placement_.attributes.data();
        for (uint32_t r = 0; r < rows; ++r)
        {
            Lanes residual = (group_.wedgeAttributes(before[0])[r] + group_.wedgeAttributes(before[1])[r] +
                              group_.wedgeAttributes(before[2])[r]) *
                             splat(1.0f / 3);
            for (size_t k = 0; k < 3; ++k)
                residual -= of_after[group_.firstRow(after[k]) + r] * splat(parts[k]);
            residual *= splat(area);
            for (size_t k = 0; k < 3; ++k)
                attribute_residuals_[group_.firstRow(after[k]) + r] += residual * splat(parts[k]);
        }
        for (size_t k = 0; k < 3; ++k)
            attribute_weights_[after[k]] += parts[k] * area;
    }

    void changeAttributes(WedgeId wedge)
    {
        const Lanes step = splat(kOverrelaxation / attribute_weights_[wedge]);
        const size_t first = group_.firstRow(wedge);
        for (size_t row = first; row < first + group_.attribute_rows; ++row)
            placement_.attributes[row] += attribute_residuals_[row] * step;
    }

    void move(PositionId position)
    {
        const Lanes step =
            position_residuals_[position] * splat(kOverrelaxation / position_residuals_[position][3]);
        const Float3 object_position =
            toObjectSpace(group_, placement_.positions[position] + Float3{step[0], step[1], step[2]});
        const Float3 place = toLocalSpace(group_, object_position);
        if (flipsTriangle(position, place))
            return;
        placement_.positions[position] = place;
        placement_.object_positions[position] = object_position;
    }

    bool flipsTriangle(PositionId position, Float3 place) const
    {
        const IdVector<PositionId, Float3>& positions = placement_.positions;
        for (const TriangleId triangle : after_.triangles_at.list(position))
        {
            const std::array<PositionId, 3> p = after_.position_ids.triangle(triangle);
            const size_t k = (p[1] == position ? 1u : 0u) + (p[2] == position ? 2u : 0u);
            if (moveFlipsTriangle(positions[p[(k + 1) % 3]], positions[p[(k + 2) % 3]], positions[position],
                                  place))
                return true;
        }
        return false;
    }

    void measure(TrianglePoint& point, PositionId position) const
    {
        if (point.triangle == kInvalid)
            return;
        const Float3 away = group_.positions[position] - trianglePosition(point, after_.triangles);
        point.distance2 = dot(away, away);
    }

    const GroupMesh& group_;
    Placement& placement_;
    CornerSpan<const WedgeId> corners_; ///< wedges of the new surface's triangles
    Surface& after_;
    SurfacePoints& points_;
    IdVector<PositionId, Lanes> position_residuals_; ///< sum, and its weight
    IdVector<PositionId, float> exact_weights_; ///< part of the weight that is already on the new surface
    float exact_distance2_;                     ///< resolution of the grid
    std::vector<Lanes> attribute_residuals_;    ///< rows of each wedge
    IdVector<WedgeId, float> attribute_weights_;
};

} // namespace

void fitToGroup(const GroupMesh& group, SimplifiedGroup& simplified, Surface& after, SurfacePoints& points)
{
    HEARTH_ASSERT(points.of_middle.empty() || points.of_middle.size() == group.triangleCount());
    HEARTH_ASSERT(points.of_position.size() == group.positions.size() &&
                  points.of_wedge.size() == group.vertex_of_wedge.size());
    HEARTH_ASSERT(after.triangleCount() == simplified.triangleCount());
    if (!points.of_middle.empty())
        SurfaceFit(group, simplified, after, points).run();
}

} // namespace hearth::clusters
