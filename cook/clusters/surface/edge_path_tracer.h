// Traces the half-edges (triangle edges) of a surface over the simplified surface. See
// cook/clusters/README.md, "Error".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/simplify/simplify.h"
#include "cook/clusters/surface/opposite_half_edges.h"
#include "cook/clusters/surface/surface.h"
#include "cook/clusters/surface/surface_points.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Point in a triangle by barycentric coordinates: (1 - v - w) * corner 0 + v * corner 1 + w * corner 2.
struct BarycentricPoint
{
    float v = 0, w = 0;
};

/// Return corner k of a triangle as a point.
inline BarycentricPoint cornerPoint(uint32_t k)
{
    return {k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f};
}

/// Point of the simplified surface that a position maps to: one of its positions, which belongs to all
/// triangles around it, or a point within a triangle.
struct MappedPoint
{
    TriangleId triangle = kInvalid;
    PositionId vertex = kInvalid;
    BarycentricPoint at;
    float distance = 0; ///< distance between the position and the point

    bool isVertex() const { return vertex != kInvalid; }
    bool isValid() const { return triangle != kInvalid; }
};

/// Crossing of a traced path from triangle to triangle.
struct Crossing
{
    /// Half-edge of the triangle before, and its opposite in the triangle behind.
    std::array<HalfEdgeId, 2> half_edges;
    float t;        ///< from the start (0) to the end (1) of the half-edge that is left
    float distance; ///< distance from the point of the traced half-edge that maps there

    HalfEdgeId leaving() const { return half_edges[0]; }
    HalfEdgeId entering() const { return half_edges[1]; }
};

/// Traced path of a half-edge: from the point that its start maps to, to that of its end.
struct TracedPath
{
    HalfEdgeId half_edge{};
    uint32_t first = 0; ///< first crossing
    uint32_t count = 0; ///< number of crossings
    TriangleId from{}, to{};
    float distance = -1; ///< largest distance of the crossings; less than 0: no path was found

    bool isFound() const { return distance >= 0; }
};

/// Traces half-edges of the surface before over the surface after.
class EdgePathTracer
{
public:
    EdgePathTracer(const GroupMesh& group, const SimplifiedGroup& simplified,
                   CornerSpan<const PositionId> positions_before, const Surface& after,
                   IdSpan<PositionId, const TrianglePoint> points);

    const MappedPoint& mappedPoint(PositionId position) const { return mapped_points_[position]; }

    /// Return the coordinates of a mapped position in a triangle that contains it.
    BarycentricPoint pointIn(TriangleId triangle, const MappedPoint& mapped) const
    {
        return mapped.isVertex() ? cornerPoint(cornerNumber(cornerAt(triangle, mapped.vertex))) : mapped.at;
    }

    /// Trace the path of a half-edge; call once for each.
    void tracePath(HalfEdgeId half_edge);

    /// Return the path of a half-edge that was traced.
    const TracedPath& tracedPath(HalfEdgeId half_edge) const { return paths_[path_of_half_edge_[half_edge]]; }

    std::span<const Crossing> crossings(const TracedPath& path) const
    {
        return std::span(crossings_).subspan(path.first, path.count);
    }

    /// Return all traced paths.
    std::span<const TracedPath> paths() const { return paths_; }

    IdSpan<HalfEdgeId, const HalfEdgeId> opposites() const { return opposites_; }

    /// Return the half-edges to cross from a triangle to another one around the same position, by the
    /// shorter turn; empty if there is none.
    std::span<const HalfEdgeId> turn(PositionId vertex, TriangleId from, TriangleId to);

private:
    void findMappedPoints(const GroupMesh& group, const SimplifiedGroup& simplified,
                          IdSpan<PositionId, const TrianglePoint> points);
    bool tracePath(const MappedPoint& start, const MappedPoint& end, TracedPath& path);
    bool traceStraight(const MappedPoint& start, const MappedPoint& end, TracedPath& path);
    TriangleId commonTriangle(const MappedPoint& a, const MappedPoint& b) const;
    bool traceShortest(const MappedPoint& start, const MappedPoint& end, TracedPath& path);
    void cross(HalfEdgeId half_edge, TracedPath& path);
    Float3 mappedPosition(const MappedPoint& mapped) const;
    bool contains(TriangleId triangle, const MappedPoint& mapped) const;

    /// Return the corner of a triangle that lies at a position, or kInvalid.
    CornerId cornerAt(TriangleId triangle, PositionId position) const
    {
        const auto [a, b, c] = after_.position_ids.triangle(triangle);
        return a == position   ? makeCorner(triangle, 0)
               : b == position ? makeCorner(triangle, 1)
               : c == position ? makeCorner(triangle, 2)
                               : CornerId{kInvalid};
    }

    /// Line that a traced path follows. signedArea(position) is twice the signed area that a corner
    /// spans with the line, seen from above: positive to its left.
    struct Line
    {
        Float3 origin, left;
        float signedArea(Float3 place) const { return dot(left, place - origin); }
    };

    CornerSpan<const PositionId> position_ids_;
    IdSpan<PositionId, const Float3> local_positions_;
    const Surface& after_;
    IdVector<HalfEdgeId, HalfEdgeId> opposites_; ///< opposite half-edges of the surface after
    IdVector<PositionId, MappedPoint> mapped_points_;
    IdVector<HalfEdgeId, uint32_t> path_of_half_edge_; ///< of the half-edges before
    std::vector<TracedPath> paths_;
    std::vector<Crossing> crossings_;
    std::vector<HalfEdgeId> turn_;

    // of the half-edge that is traced
    Float3 from_, to_;
    Line line_;
};

} // namespace hearth::clusters
