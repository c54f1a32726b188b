// Convex hulls of points on a lattice, in exact arithmetic.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::proxy
{

/// Maximum magnitude of a lattice coordinate: volumes of tetrahedra then fit into 64 bits.
inline constexpr int32_t kMaxLatticeCoordinate = 1 << 19;

/// Point of a lattice, in whole steps.
struct LatticePoint
{
    int32_t x = 0, y = 0, z = 0;

    auto operator<=>(const LatticePoint&) const = default;
};

/// Convex polyhedron.
struct Hull
{
    std::vector<LatticePoint> points; ///< its vertices alone
    std::vector<std::array<uint32_t, 3>>
        triangles; ///< counter-clockwise from outside; none: it has no volume
};

/// Return the convex hull, by quickhull (C. B. Barber et al., "The Quickhull Algorithm for Convex Hulls",
/// 1996). A set without volume, of points in one plane, has a hull without points and triangles. Time O(n log
/// n) for most sets.
/// points      coordinates of at most kMaxLatticeCoordinate (asserted)
/// max_points  at least 4: the hull grows by the farthest point until it has that many, and need then not
///             hold all points
Hull makeHull(std::span<const LatticePoint> points, size_t max_points = SIZE_MAX);

/// Return whether a hull with volume holds a point, exactly.
bool holds(const Hull& hull, LatticePoint point);

/// Return the volume in cubic steps.
double findVolume(const Hull& hull);

/// Return the area in square steps.
double findArea(const Hull& hull);

} // namespace hearth::proxy
