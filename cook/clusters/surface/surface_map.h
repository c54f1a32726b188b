// Continuous map from the surface before a simplification to the surface after it. See
// cook/clusters/README.md, "Error".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/simplify/simplify.h"
#include "cook/clusters/surface/edge_path_tracer.h"
#include "cook/clusters/surface/loop_fill.h"
#include "cook/clusters/surface/surface.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Maps each triangle before, cut into pieces that lie in one triangle after each. Their corners are corners
/// of triangles, crossings of the traced paths of their half-edges, and points that lie at positions after.
/// No point of a piece is farther from its mapped point than the farthest of the piece's corners.
class SurfaceMap
{
public:
    /// points            points of the surface after that positions map to
    /// wanted            for each triangle before: 1 to map it; others are still present unchanged
    SurfaceMap(const GroupMesh& group, const SimplifiedGroup& simplified,
               CornerSpan<const PositionId> positions_before, const Surface& after,
               IdSpan<PositionId, const TrianglePoint> points, IdSpan<TriangleId, const uint8_t> wanted);

    IdSpan<HalfEdgeId, const HalfEdgeId> oppositesBefore() const { return opposites_; }

    bool maps(TriangleId triangle) const { return distances_[triangle] >= 0; }

    /// Return the largest distance of a point of a mapped triangle before to its mapped point.
    float maxDistance(TriangleId triangle) const { return distances_[triangle]; }

    /// True if each point of a triangle after is the mapped point of some triangle before.
    bool covers(TriangleId new_triangle) const { return covered_[new_triangle] != 0; }

    /// Return, for each triangle after, the largest sum of the value that a mapped triangle carries and the
    /// distance of a corner of its pieces there.
    /// carried  for each triangle before
    IdVector<TriangleId, float> maxSums(IdSpan<TriangleId, const float> carried) const;

    /// Call visit(triangle) for the triangles that a mapped triangle's border passes through.
    template <typename Visit>
    void forEachSourceTriangle(TriangleId triangle, Visit visit) const
    {
        for (const HalfEdgeId half_edge : makeCorners(triangle))
        {
            const TracedPath& path = tracer_.tracedPath(std::min(half_edge, opposites_[half_edge]));
            visit(path.from);
            for (const Crossing& crossing : tracer_.crossings(path))
                visit(cornerTriangle(crossing.entering()));
        }
    }

private:
    /// Corner of a triangle's pieces that lies at a position after, in all triangles around it.
    struct InnerPoint
    {
        TriangleId triangle;
        PositionId position;
        float distance;
    };

    /// Triangle that the border of another one passes through at a single point, where a corner lies at a
    /// position after.
    struct PassedTriangle
    {
        TriangleId triangle;
        TriangleId new_triangle;
        float distance;
    };

    void tracePaths(IdSpan<TriangleId, const uint8_t> wanted);
    bool mapTriangle(TriangleId triangle);
    void follow(const TracedPath& path, bool backwards);
    bool turn(TriangleId triangle, const MappedPoint& mapped, TriangleId from, TriangleId to);
    void addInner(TriangleId triangle, PositionId position, float distance);
    void findCovered();
    void markOpenAlong(HalfEdgeId half_edge);
    void markOpenBetween(TriangleId new_triangle, BarycentricPoint a, BarycentricPoint b);

    const GroupMesh& group_;
    CornerSpan<const PositionId> positions_;
    const Surface& after_;
    IdVector<HalfEdgeId, HalfEdgeId> opposites_; ///< opposite half-edges before
    EdgePathTracer tracer_;
    LoopFiller fill_;
    IdVector<TriangleId, float> distances_; ///< for each triangle before; less than 0 if it is not mapped
    std::vector<InnerPoint> inner_;
    std::vector<PassedTriangle> passed_;
    /// 1 for each half-edge after that is covered once and decides for its triangle.
    IdVector<HalfEdgeId, uint8_t> decides_;
    IdVector<TriangleId, uint8_t>
        open_; ///< for each triangle after: parts may be covered more often than others
    IdVector<TriangleId, uint8_t> covered_; ///< for each triangle after
};

} // namespace hearth::clusters
