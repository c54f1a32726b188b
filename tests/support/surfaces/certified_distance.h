// Distances between surfaces with a proof: no point of a surface is farther than the upper bound, and some
// point is as far as the lower one. Branch and bound over triangles, as in M. Tang, M. Lee, Y. J. Kim,
// "Interactive Hausdorff distance computation for general polygonal models", 2009. The reference for tests of
// stored errors; it shares nothing with cook/clusters.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/surfaces/surface_distance.h"

#include <cstddef>
#include <span>

namespace hearth
{

struct DistanceBounds
{
    double lower = 0, upper = 0;
};

/// Limits of a search.
struct DistanceSearch
{
    double relative = 0.02; ///< the search ends where upper <= lower * (1 + relative) + absolute
    double absolute = 0;
    double known = 0;            ///< distances up to this make no difference: the least lower bound
    size_t max_pieces = 4000000; ///< pieces of triangles after which it ends in any case: upper may be loose
};

/// Bound the largest distance of a point of the triangles to the surface `to` (one-sided Hausdorff distance).
/// The bounds hold within the rounding of floats at the size of the coordinates.
DistanceBounds certifyOneSided(std::span<const Float3> positions, std::span<const uint32_t> triangles,
                               const SurfaceDistance& to, const DistanceSearch& search);

/// Surface of triangles over positions.
struct TriangleSurface
{
    std::span<const Float3> positions;
    std::span<const uint32_t> triangles;
};

/// Bound the Hausdorff distance of two surfaces, both ways.
DistanceBounds certifyDistance(const TriangleSurface& a, const TriangleSurface& b,
                               const DistanceSearch& search);

} // namespace hearth
