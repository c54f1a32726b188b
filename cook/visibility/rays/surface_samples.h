// Distributes the sample points over a mesh at which visibility is measured.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/mesh/surface_sample.h"

#include <vector>

namespace hearth::visibility
{

struct SurfaceSampleSettings
{
    double samples_per_vertex = 8; ///< samples of the whole mesh, for each of its positions; at least 0
    /// Minimum for each triangle, so that triangles with little area are sampled, too; at least 1.
    uint32_t min_per_triangle = 1;
    /// Minimum for all triangles around a vertex together. Each triangle gets the share of its corner with
    /// the fewest triangles, up to nine tenths of all samples. Around a vertex with little area, such as a
    /// single small triangle at a hard edge or a border, counts by area alone are so small that their noise
    /// becomes the vertex's.
    double min_per_vertex = 0;
    uint64_t seed = 0;
};

/// Distribute samples evenly by area, apart from triangles with their minimum number, and stratified: the
/// counts follow the areas along the Morton curve without drift, and the points within a triangle are a net.
/// Triangles without area get no samples. The areas of a triangle's samples sum to the triangle's area.
/// Deterministic, O(T log T + S log S).
///
/// positions  finite, metres
/// corners    three position indices for each triangle, in range (asserted); equal indices are one vertex
/// returns    in the order of the Morton curve, so that neighbours have similar visibility. More than
///            settings.samples_per_vertex asks for if the minimums of the triangles alone exceed it
std::vector<SurfaceSample> surfaceSamples(std::span<const Float3> positions,
                                          std::span<const uint32_t> corners,
                                          const SurfaceSampleSettings& settings);

} // namespace hearth::visibility
