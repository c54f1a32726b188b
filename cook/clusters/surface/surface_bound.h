// How far two surfaces lie from each other, as a bound, for whole meshes. See cook/clusters/README.md, "Authored levels".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <span>

namespace hearth::clusters
{

/// A surface: three indices into `positions` for each triangle.
struct SurfaceView
{
    std::span<const Float3> positions;
    std::span<const uint32_t> triangles;
};

struct SurfaceBound
{
    double upper = 0;          ///< every point of either surface has a point of the other one within it
    double sure = 0;           ///< some point of one surface is so far from the other
    uint64_t loose_pieces = 0; ///< pieces whose bound was taken before the search for a better one ended
};

/// The two-sided distance of two surfaces: `upper` is at most 1.1 times the larger of `sure` and `enough`, but for loose
/// pieces. Deterministic, whatever the number of threads. Time O(n log n) for surfaces that lie close to each other
/// in parts of their size; a million triangles on either side take seconds.
///
/// a, b     at least one triangle each; finite (asserted: not empty)
/// enough   a distance that need not be told from smaller ones, >= 0
SurfaceBound boundSurfaces(const SurfaceView& a, const SurfaceView& b, double enough);

} // namespace hearth::clusters
