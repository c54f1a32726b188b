// Bounding volume hierarchy of a surface for nearest-triangle queries.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/surface/surface_bound.h"
#include "cook/mesh/triangle_tree.h"
#include "formats/base/double3.h"

#include <array>

namespace hearth::clusters
{

/// Corners in double precision: results are compared with numbers ten thousand times smaller than
/// coordinates.
using Corners3 = std::array<Double3, 3>;

/// Return the vector from the closest point of a triangle, needles included, to a point. Never too short
/// except for rounding.
Double3 offsetFromTriangle(Double3 point, const Corners3& triangle);

/// Return the squared length of offsetFromTriangle.
double distance2(Double3 point, const Corners3& triangle);

/// Bounding volume hierarchy over the triangles of a surface.
class SurfaceTree
{
public:
    explicit SurfaceTree(const SurfaceView& surface);

    struct Nearest
    {
        TriangleId triangle{};
        double distance2 = 0;
    };

    /// Find the triangle nearest to a point; or, as soon as one is found, any whose squared distance is at
    /// most `enough2`.
    /// hint  a triangle that is probably near
    Nearest nearest(Double3 point, double enough2, TriangleId hint) const;

    Corners3 triangle(TriangleId triangle) const;

private:
    SurfaceView surface_;
    mesh::TriangleTree tree_;
};

} // namespace hearth::clusters
