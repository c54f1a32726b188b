// Bounds the distance between two surfaces (Hausdorff distance), for whole meshes. See
// cook/clusters/README.md, "Authored LODs".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/index_types.h"
#include "formats/base/math.h"

#include <cstdint>

namespace hearth::clusters
{

/// Triangulated surface of a whole mesh.
struct SurfaceView
{
    IdSpan<VertexId, const Float3> positions;
    CornerSpan<const VertexId> corners;
};

/// Bounds of the two-sided distance of two surfaces.
struct SurfaceBound
{
    double upper = 0; ///< every point of either surface has a point of the other one within this distance
    double sure = 0;  ///< some point of one surface is this far from the other
    uint64_t loose_pieces = 0; ///< pieces whose search ended early, so that their bounds are not tight
};

/// Bounds of each surface's distance to the other one.
struct SurfaceBounds
{
    SurfaceBound a; ///< of the points of the first surface
    SurfaceBound b; ///< of the points of the second one
};

/// Bound the distance of each surface's points to the other surface, as boundSurfaces.
SurfaceBounds boundSurfaceSides(const SurfaceView& a, const SurfaceView& b, double enough);

/// Bound the two-sided distance of two surfaces: `upper` is at most 1.1 times the larger of `sure` and
/// `enough`, except for loose pieces. Deterministic for any number of threads. Time O(n log n) for surfaces
/// that lie close to each other relative to their size; a million triangles on either side take seconds.
///
/// a, b     at least one triangle each; finite (asserted: not empty)
/// enough   smaller distances need not be distinguished from this one, >= 0
SurfaceBound boundSurfaces(const SurfaceView& a, const SurfaceView& b, double enough);

} // namespace hearth::clusters
