// Fits visibility for every level of a cluster hierarchy, each to the samples of the finest level.
// See cook/visibility/README.md, "Levels".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/vertex_fit.h"

#include <algorithm>
#include <vector>

namespace hearth::visibility
{

/// Triangles that a uniform cut through the hierarchy draws.
struct LevelMesh
{
    MeshView mesh;
    /// For each vertex, the vertex of the next finer level (the previous element) whose value it must copy,
    /// or kInvalidIndex. Empty for the finest. Cuts that mix the two levels meet in these vertices.
    std::span<const uint32_t> finer_vertex;
    /// Maximum distance between a sample and this level's surface: larger than the level's error, smaller
    /// than the distance of another side of the object. Units of the positions; 0: a twentieth of the
    /// diagonal of the finest level's box.
    float reach = 0;
    /// For each vertex, the first one of this level with the same position and normal. Empty: not needed.
    std::span<const uint32_t> first_copy = {};
};

struct LevelFitSettings
{
    FitMeshSettings fit_mesh;
    FitSettings fit;
    /// Minimum factor of alpha on a coarser level. The factor is the square of the level's number of vertices
    /// by the finest level's: the same penalty of curvature in metres on each level, so that levels approach
    /// one function. With one alpha for all levels, coarse ones would be so blurred that copies of vertices
    /// were nearer to the truth. With a smaller factor than this, noise would come through at the samples
    /// that a vertex has.
    double min_alpha_factor = 0.03;

    /// Return the factor of alpha on a mesh with `ratio` times the vertices of the finest level.
    double alphaFactor(double ratio) const { return std::clamp(ratio * ratio, min_alpha_factor, 1.0); }
};

struct LevelFit
{
    std::vector<Moments> moments; ///< for each vertex of the level's mesh
    FitStatistics statistics;     ///< `held` counts vertices of the fit mesh
    FitMeshStatistics fit_mesh;
    uint32_t samples = 0; ///< used samples; statistics.lost_samples of them lie nowhere on this level
};

/// Fit all levels, finest first. Held vertices have the bits of the next finer level, so that mixed cuts have
/// no jumps. The samples of a coarser level are the means of those of the next finer level's triangles. Each
/// is moved to the nearest point that faces the same way.
/// samples  on the triangles of levels[0]
/// values   one for each sample
std::vector<LevelFit> fitLevels(std::span<const LevelMesh> levels, std::span<const SurfaceSample> samples,
                                std::span<const Moments> values, const LevelFitSettings& settings = {});

/// Move samples to the closest points of another surface that face the same way as their triangles. The
/// triangle of a sample is kInvalidIndex if no such point is within `reach`. The same for any number of
/// threads.
/// from  mesh that the samples lie on
std::vector<SurfaceSample> moveSamples(const MeshView& from, std::span<const SurfaceSample> samples,
                                       const MeshView& to, double reach);

/// Samples with their values.
struct SampledValues
{
    std::vector<SurfaceSample> samples;
    std::vector<Moments> values;
};

/// Replace the samples of each triangle by their mean, at their mean position, which has the same integral of
/// any function that is linear on the triangle. By area and weight; without samples on no triangle.
/// returns  in the order of the triangles
SampledValues averageByTriangle(std::span<const SurfaceSample> samples, std::span<const Moments> values,
                                size_t triangle_count);

} // namespace hearth::visibility
