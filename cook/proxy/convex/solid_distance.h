// Bounds how far triangles reach from a solid: from the inside of closed shells, and from open ones.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/closest_point.h"
#include "cook/proxy/surface/surface.h"
#include "cook/ray_scene/triangle_rays.h"

#include <array>
#include <limits>
#include <span>

namespace hearth::proxy
{

/// Shells of a surface: triangles that edges connect.
struct Shells
{
    std::vector<uint32_t> of_triangle; ///< the first triangle of its shell
    std::vector<bool> is_closed;       ///< [triangles], of its shell
};

Shells findShells(const Surface& surface);

/// A surface, and the inside of its closed shells. Build once, then use from many threads.
class Solid
{
public:
    /// surface  a manifold whose closed shells face outwards, with at least one triangle; kept
    explicit Solid(const Surface& surface);

    const Surface& surface() const { return surface_; }
    const Shells& shells() const { return shells_; }

    /// Return an upper bound of the distance from the solid, in metres, over all points of the triangles: at
    /// most 1.1 times the greatest distance, or `enough` above it.
    /// triangles  corners in metres
    /// enough     > 0; time grows with the inverse square of it near the solid
    /// limit      the search ends as soon as the bound is certain to be greater, and more than the limit is
    ///            returned
    double boundDistance(std::span<const std::array<Float3, 3>> triangles, double enough,
                         double limit = std::numeric_limits<double>::infinity()) const;

private:
    /// Return whether a point is inside of a closed shell. One that is inside of several may count as
    /// outside.
    bool isInside(Float3 point) const;

    const Surface& surface_;
    Shells shells_;
    mesh::ClosestPoint closest_;
    ray_scene::TriangleRays closed_shells_;
};

} // namespace hearth::proxy
