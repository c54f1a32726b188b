// Searches the triangles of a wrap's source: by distance, and for those that a small body may touch. The
// exact tests of the few triangles that remain are left to CGAL (cgal_wrap.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/surface/surface_tree.h"
#include "cook/mesh/triangle_tree.h"
#include "cook/wrap/surface.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::wrap
{

/// Triangle or tetrahedron. It tells in doubles what it does not touch, never wrongly: bounds of rounding are
/// part of the tests.
class ConvexBody
{
public:
    /// corners  3 or 4
    explicit ConvexBody(std::span<const Double3> corners);

    Double3 center() const;
    bool mayTouch(const Box3& box) const;
    bool mayTouch(const clusters::Corners3& triangle) const;

private:
    /// Plane through a point of the body, which lies behind it.
    struct Plane
    {
        Double3 point;
        Double3 normal;  ///< outwards; of any length
        double rounding; ///< bounds the error of dot(normal, x - point), over the sum of |x - point|

        bool isInFront(Double3 x) const;
    };

    static Plane makePlane(const clusters::Corners3& corners);
    void addFaces();

    std::array<Double3, 4> corners_{};
    size_t corner_count_;
    Double3 low_, high_;
    std::array<Plane, 4> planes_{};
    size_t plane_count_ = 0;
};

/// Bounding volume hierarchy over the triangles of a surface. Long triangles are in it as several boxes, each
/// around a piece.
class SourceTree
{
public:
    /// surface     at least one triangle; kept by reference
    /// max_edge_m  triangles with longer edges have several boxes
    SourceTree(const Surface& surface, double max_edge_m);

    const Surface& surface() const { return surface_; }
    clusters::Corners3 corners(uint32_t triangle) const;

    struct Nearest
    {
        uint32_t triangle = 0;
        Double3 offset; ///< from the closest point of the triangle to the point
        double distance2 = 0;
    };

    /// Find the triangle nearest to a point.
    /// hint  a triangle that is probably near; decides between triangles at equal distances
    Nearest findNearest(Double3 point, uint32_t hint) const;

    /// True if a triangle is at most sqrt(`distance2`) away from a point.
    bool isWithin(Double3 point, double distance2) const;

    /// True if `touches` is true for a triangle that the body may touch.
    template <typename Touches>
    bool hasTouching(const ConvexBody& body, const Touches& touches) const
    {
        bool found = false;
        tree_.visitBoxes(
            body.center(), [&](const Box3& box) { return !found && body.mayTouch(box); },
            [&](uint32_t i)
            {
                const uint32_t triangle = triangle_of_piece_[tree_.order()[i]];
                found = found || (body.mayTouch(corners(triangle)) && touches(triangle));
            });
        return found;
    }

private:
    const Surface& surface_;
    std::vector<uint32_t> triangle_of_piece_;
    mesh::TriangleTree tree_; ///< over the boxes of pieces
};

} // namespace hearth::wrap
