// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/error/attribute_error.h"

#include "cook/clusters/core/bounds.h"
#include "cook/clusters/core/cluster.h"
#include "cook/clusters/surface/surface.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace hearth::clusters
{

namespace
{

// UV differences beyond this, in local lengths, count the same: their squares stay finite.
constexpr float kMaxUvLength = 1e6f;

float dot(Float2 a, Float2 b)
{
    return a.x * b.x + a.y * b.y;
}

/// Clamp a length; NaN becomes the limit as well.
float clampLength(float length)
{
    return length > -kMaxUvLength && length < kMaxUvLength ? length : kMaxUvLength;
}

struct Difference
{
    Float3 normal;
    Float2 uv; ///< local lengths
    float normal2 = 0;
    float uv2 = 0;
};

class AttributeMeasure
{
public:
    AttributeMeasure(const GroupMesh& group, const NewSurface& after)
        : group_(group),
          after_(after),
          simplified_(after.simplified),
          triangles_(after.surface.triangles),
          has_normals_(!after.mesh.normals.empty()),
          has_uvs_(!after.mesh.uvs[0].empty() && group.uv_length > 0),
          differences_(group.vertex_of_wedge.size())
    {
    }

    AttributeStep run()
    {
        if (!has_normals_ && !has_uvs_)
            return {};
        for (const WedgeId wedge : differences_.ids())
            if (const TrianglePoint& point = after_.points[wedge]; point.triangle != kInvalid)
                differences_[wedge] = differenceAt(wedge, point);
        return {meanOfDifferences(), edgeLength()};
    }

private:
    /// Return the new surface's attributes minus the wedge's.
    Difference differenceAt(WedgeId wedge, const TrianglePoint& point) const
    {
        const uint32_t vertex = toIndex(group_.vertex_of_wedge[wedge]);
        const mesh::SourceMesh& mesh = after_.mesh;
        Difference difference;
        if (has_normals_)
            difference.normal =
                normalizeOr(valueAt(point, mesh.normals, after_.made.normals), {}) - mesh.normals[vertex];
        if (has_uvs_)
        {
            const Float2 away = valueAt(point, mesh.uvs[0], after_.made.uvs[0]) - mesh.uvs[0][vertex];
            difference.uv = {clampLength(away.x * group_.uv_length), clampLength(away.y * group_.uv_length)};
        }
        difference.normal2 = hearth::dot(difference.normal, difference.normal);
        difference.uv2 = dot(difference.uv, difference.uv);
        return difference;
    }

    /// Interpolate a vertex attribute of the new surface at a point.
    template <typename Value>
    Value valueAt(const TrianglePoint& point, const std::vector<Value>& of_mesh,
                  const std::vector<Value>& of_made) const
    {
        const auto value = [&](WedgeId wedge)
        {
            const VertexId vertex = after_.vertex_of_wedge[wedge];
            return isNewVertex(vertex) ? of_made[newVertexNumber(vertex)] : of_mesh[toIndex(vertex)];
        };
        const auto [a, b, c] = simplified_.corners.triangle(point.triangle);
        return value(a) * (1 - point.v - point.w) + value(b) * point.v + value(c) * point.w;
    }

    bool isPruned(TriangleId triangle) const
    {
        const auto gone = [&](WedgeId wedge)
        { return simplified_.target_of_position[group_.position_id_of_wedge[wedge]] == kPruned; };
        const auto [a, b, c] = group_.corners.triangle(triangle);
        return simplified_.pruned && (gone(a) || gone(b) || gone(c));
    }

    /// Integrate linear functions: the mean square over a triangle is the sum of the squares of the corner
    /// values and of their sum, divided by 12.
    AttributeError meanOfDifferences() const
    {
        double area = 0, normal2 = 0, uv2 = 0;
        for (const TriangleId triangle : group_.corners.triangles())
        {
            if (isPruned(triangle))
                continue;
            const auto [a, b, c] = group_.trianglePositions(triangle);
            const auto own = double{length(cross(b - a, c - a))};
            const std::array<WedgeId, 3> wedges = group_.corners.triangle(triangle);
            const Difference& d0 = differences_[wedges[0]];
            const Difference& d1 = differences_[wedges[1]];
            const Difference& d2 = differences_[wedges[2]];
            const Float3 normal = d0.normal + d1.normal + d2.normal;
            area += own;
            normal2 += own * double{d0.normal2 + d1.normal2 + d2.normal2 + hearth::dot(normal, normal)};
            if (!has_uvs_)
                continue;
            const Float2 uv = d0.uv + d1.uv + d2.uv;
            uv2 += own * double{d0.uv2 + d1.uv2 + d2.uv2 + dot(uv, uv)};
        }
        if (!(area > 0))
            return {};
        return {static_cast<float>(angleFromChord(std::sqrt(normal2 / (12 * area)))),
                roundUp(std::sqrt(uv2 / (12 * area)) * group_.scale)};
    }

    float edgeLength() const
    {
        double sum = 0;
        for (const DistanceTriangle& triangle : triangles_)
            sum += double{triangle.ab_ab + triangle.ac_ac - triangle.ab_ac};
        return roundUp(group_.scale * std::sqrt(sum * 2 / (3 * static_cast<double>(triangles_.size()))));
    }

    const GroupMesh& group_;
    const NewSurface& after_;
    const SimplifiedGroup& simplified_;
    std::span<const DistanceTriangle> triangles_;
    bool has_normals_;
    bool has_uvs_;
    IdVector<WedgeId, Difference> differences_;
};

} // namespace

AttributeStep measureAttributes(const GroupMesh& group, const NewSurface& after)
{
    HEARTH_ASSERT(after.points.size() == group.vertex_of_wedge.size() &&
                  after.vertex_of_wedge.size() == group.vertex_of_wedge.size());
    HEARTH_ASSERT(after.surface.triangleCount() == after.simplified.triangleCount());
    return AttributeMeasure(group, after).run();
}

double angleFromChord(double chord)
{
    // halve the half-angle twice: then five terms of the series of asin are exact to 1e-7
    const auto halve = [](double sine) { return sine / std::sqrt(2 * (1 + std::sqrt(1 - sine * sine))); };
    const double x = halve(halve(std::min(chord / 2, 1.0)));
    const double x2 = x * x;
    return 8 * x * (1 + x2 * (1.0 / 6 + x2 * (3.0 / 40 + x2 * (15.0 / 336 + x2 * (105.0 / 3456)))));
}

} // namespace hearth::clusters
