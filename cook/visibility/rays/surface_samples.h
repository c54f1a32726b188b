// Where on a mesh visibility is measured.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/mesh/mesh_view.h"

#include <vector>

namespace hearth::visibility
{

struct SurfaceSampleSettings
{
    double samples_per_vertex = 8; ///< what the whole mesh gets for each of its positions; at least 0
    uint32_t least_per_triangle =
        1; ///< so that those are seen, too, that the others leave no area to; at least 1
    /// What the triangles around a vertex get together, at least: each the share of its corner that has the fewest
    /// triangles, as far as nine tenths of all samples go. Around a vertex with little area, as where a hard edge or a
    /// border leaves it one small triangle, area alone gives so few that their noise is the vertex'.
    double least_per_vertex = 0;
    uint64_t seed = 0;
};

/// Even in area, apart from triangles that would get less than their least number, and stratified: the counts follow the
/// areas along the Morton curve without drifting, and within a triangle the points are a net. Triangles without area
/// get no samples. The areas of a triangle's samples sum to the triangle's.
/// Deterministic, O(T log T + S log S).
///
/// positions  finite, metres
/// corners    three positions' indices for each triangle, in range (asserted); equal ones are one vertex
/// returns    along the Morton curve, so that neighbours see alike. More than settings.samples_per_vertex ask for where
///            the least number of each triangle is more already
std::vector<SurfaceSample> surfaceSamples(std::span<const Float3> positions,
                                          std::span<const uint32_t> corners,
                                          const SurfaceSampleSettings& settings);

} // namespace hearth::visibility
