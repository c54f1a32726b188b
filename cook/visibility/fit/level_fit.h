// Fits visibility for every level of a cluster hierarchy, each to the samples of the finest level.
// See cook/visibility/README.md, "Levels".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/vertex_fit.h"

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
    /// diagonal of the samples' box.
    float reach = 0;
};

struct LevelFitSettings
{
    ProxySettings proxy;
    FitSettings fit;
    /// Maximum on a coarser level, so that all levels together take little time: four times the finest
    /// level's default.
    uint32_t samples_per_vertex = 32;
    /// Minimum factor of alpha on a coarser level. The factor is the square of the level's number of vertices
    /// by the finest level's: the same penalty of curvature in metres on each level, so that levels approach
    /// one function. With one alpha for all levels, coarse ones would be so blurred that copies of vertices
    /// were nearer to the truth. With a smaller factor than this, noise would come through at the samples
    /// that a vertex has.
    double min_alpha_factor = 0.03;
};

struct LevelFit
{
    std::vector<Moments> moments; ///< for each vertex of the level's mesh
    FitStatistics statistics;     ///< `held` counts vertices of the proxy
    ProxyStatistics proxy;
    uint32_t samples = 0; ///< used samples; statistics.lost_samples of them lie nowhere on this level
};

/// Fit all levels, finest first. Held vertices have the bits of the next finer level, so that mixed cuts have
/// no jumps. Coarser levels use an even choice of samples by area, in the order of the samples, which should
/// keep neighbours together (Morton order). Each sample is moved to the nearest point that faces the same
/// way.
/// samples  on the triangles of levels[0]
/// values   one for each sample
std::vector<LevelFit> fitLevels(std::span<const LevelMesh> levels, std::span<const SurfaceSample> samples,
                                std::span<const Moments> values, const LevelFitSettings& settings = {});

/// Subset of samples: indices, ascending, and the area of each.
struct SampleSubset
{
    std::vector<uint32_t> samples;
    std::vector<float> areas;
};
/// Choose samples evenly: `count` steps of equal area along the samples, and for each step the sample at its
/// middle. The area of a chosen sample is the number of its steps times the area of a step. Returns all
/// samples unchanged if there are no more than `count`.
SampleSubset chooseSamples(std::span<const SurfaceSample> samples, size_t count);

} // namespace hearth::visibility
