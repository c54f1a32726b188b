// Finds the closest point of a surface that faces the direction of a normal, with a bounding volume hierarchy
// (BVH).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/mesh_view.h"
#include "cook/mesh/triangle_tree.h"
#include "formats/base/double3.h"
#include "formats/base/index.h"

#include <array>
#include <vector>

namespace hearth::mesh
{

/// Bounding volume hierarchy of axis-aligned boxes for closest-point queries.
class ClosestPoint
{
public:
    /// Build the hierarchy. Keeps no reference to the view.
    /// triangle_count  number of leading triangles of the mesh that are searched
    ClosestPoint(const MeshView& mesh, size_t triangle_count);

    struct Hit
    {
        uint32_t triangle = kInvalidIndex;
        float u = 0; ///< weight of corner 1
        float v = 0; ///< weight of corner 2
        double distance2 = 0;
    };

    /// Find the closest point, at most sqrt(`limit2`) away, on a triangle whose plane faces `normal`:
    /// dot > min_cosine. Triangles without area face nothing. The triangle is kInvalidIndex if there is none.
    /// normal      need not have length 1 where min_cosine is 0; 0: accept all triangles
    /// hint        triangle that is probably near, or kInvalidIndex; affects the result only for ties
    /// min_cosine  in [0, 1)
    Hit find(Float3 point, Float3 normal, double limit2, uint32_t hint, double min_cosine = 0) const;

    /// Find the closest point at any distance, on a triangle that faces `normal` as above; where there is
    /// none, on one with min_cosine 0, or else on any.
    Hit findAnywhere(Float3 point, Float3 normal, uint32_t hint, double min_cosine) const;

    /// Return the squared distance of a point to one of the triangles that are searched.
    double findDistance2(Float3 point, uint32_t triangle) const;

private:
    struct Triangle
    {
        std::array<Float3, 3> corners;
        uint32_t triangle = 0;
        Double3 normal; ///< unit; 0 without area
    };

    /// Point and direction that is searched from.
    struct Query
    {
        Double3 point;
        Double3 normal;
        bool any_side;
        double min_cosine;
    };

    void visit(const Query& query, const Triangle& item, Hit& best) const;

    TriangleTree tree_;
    std::vector<Triangle> triangles_; ///< in the order of the leaves
    std::vector<uint32_t> slot_of_triangle_;
};

} // namespace hearth::mesh
