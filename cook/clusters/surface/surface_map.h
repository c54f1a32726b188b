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
    /// positions_before  position ids, three for each triangle before
    /// points            points of the surface after that positions map to
    /// wanted            for each triangle before: 1 to map it; others are still present unchanged
    SurfaceMap(const GroupMesh& group, const SimplifiedGroup& simplified,
               std::span<const uint32_t> positions_before, const Surface& after,
               std::span<const TrianglePoint> points, std::span<const uint8_t> wanted);

    std::span<const uint32_t> oppositesBefore() const { return opposites_; }

    bool maps(size_t triangle) const { return distances_[triangle] >= 0; }

    /// Return the largest distance of a point of a mapped triangle before to its mapped point.
    float maxDistance(size_t triangle) const { return distances_[triangle]; }

    /// True if each point of a triangle after is the mapped point of some triangle before.
    bool covers(size_t new_triangle) const { return covered_[new_triangle] != 0; }

    /// Return, for each triangle after, the largest sum of the value that a mapped triangle carries and the
    /// distance of a corner of its pieces there.
    /// carried  for each triangle before
    std::vector<float> maxSums(std::span<const float> carried) const;

    /// Call visit(triangle) for the triangles that a mapped triangle's border passes through.
    template <typename Visit>
    void forEachTriangleOf(uint32_t triangle, Visit visit) const
    {
        for (uint32_t half_edge = triangle * 3; half_edge < triangle * 3 + 3; ++half_edge)
        {
            const TracedPath& path = tracer_.tracedPath(std::min(half_edge, opposites_[half_edge]));
            visit(path.from);
            for (const Crossing& crossing : tracer_.crossings(path))
                visit(crossing.entering() / 3);
        }
    }

private:
    /// Corner of a triangle's pieces that lies at a position after, in all triangles around it.
    struct InnerPoint
    {
        uint32_t triangle;
        uint32_t position;
        float distance;
    };

    /// Triangle that the border of another one passes through at a single point, where a corner lies at a
    /// position after.
    struct PassedTriangle
    {
        uint32_t triangle;
        uint32_t new_triangle;
        float distance;
    };

    void tracePaths(std::span<const uint8_t> wanted);
    bool mapTriangle(uint32_t t);
    void follow(const TracedPath& path, bool backwards);
    bool turn(uint32_t t, const MappedPoint& mapped, uint32_t from, uint32_t to);
    void addInner(uint32_t triangle, uint32_t position, float distance);
    void findCovered();
    void markOpenAlong(uint32_t half_edge);
    void markOpenBetween(uint32_t new_triangle, BarycentricPoint a, BarycentricPoint b);

    const GroupMesh& group_;
    std::span<const uint32_t> positions_;
    const Surface& after_;
    std::vector<uint32_t> opposites_; ///< opposite half-edges before
    EdgePathTracer tracer_;
    LoopFiller fill_;
    std::vector<float> distances_; ///< for each triangle before; less than 0 if it is not mapped
    std::vector<InnerPoint> inner_;
    std::vector<PassedTriangle> passed_;
    /// 1 for each half-edge after that is covered once and decides for its triangle.
    std::vector<uint8_t> decides_;
    std::vector<uint8_t> open_; ///< for each triangle after: parts may be covered more often than others
    std::vector<uint8_t> covered_;
};

} // namespace hearth::clusters
