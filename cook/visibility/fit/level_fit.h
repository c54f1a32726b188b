// Visibility for every level of a cluster hierarchy: each is fitted anew to the samples of the finest one.
// See cook/visibility/README.md, "Levels".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/vertex_fit.h"

#include <vector>

namespace hearth::visibility
{

/// The triangles that a uniform cut through the hierarchy draws.
struct LevelMesh
{
    MeshView mesh;
    /// For each vertex the vertex of the level below (the one before this, finer) that it must not differ from, or
    /// kNowhere. Empty for the finest. Cuts that mix the two levels meet in such vertices.
    std::span<const uint32_t> finer_vertex;
    /// How far samples are looked for on this level: larger than its error, less than what would be another side of
    /// the object. Units of the positions; 0: a twentieth of the diagonal of the samples' box.
    float reach = 0;
};

struct LevelFitSettings
{
    ProxySettings proxy;
    FitSettings fit;
    /// Of a level at most, so that all levels together take little time: four times what the finest has by default.
    uint32_t samples_per_vertex = 32;
    /// Jumps of gradients weigh alpha times the square of the level's vertices by the finest's: that is the same
    /// penalty of curvature in metres on each level, so that they approach one function, and with one alpha the
    /// coarse ones would be blurred until copies of vertices were nearer to the truth. Not less than this share of
    /// alpha: with the samples that a vertex has, noise would come through.
    double least_alpha = 0.03;
};

struct LevelFit
{
    std::vector<Moments> moments; ///< for each vertex of the level's mesh
    FitStatistics statistics;     ///< `held` counts vertices of the proxy
    ProxyStatistics proxy;
    uint32_t samples = 0; ///< that were used; statistics.lost_samples of them lie nowhere on this level
};

/// The finest level first. Held vertices have the bits of the level below; so, from level to level, cuts have no
/// jumps. Samples of coarser levels are an even choice by area along the order of the samples, which should be one
/// that keeps neighbours together (Morton's), each moved to the nearest point that faces its way.
/// samples  on the triangles of levels[0]
/// values   one for each sample
std::vector<LevelFit> fitLevels(std::span<const LevelMesh> levels, std::span<const SurfaceSample> samples,
                                std::span<const Moments> values, const LevelFitSettings& settings = {});

/// An even choice: `count` steps of equal area along the samples, and for each the sample that its middle falls on;
/// how often a sample is chosen is its new area. All samples as they are, if they are no more.
/// returns  indices, ascending, and the area of each
struct SampleChoice
{
    std::vector<uint32_t> samples;
    std::vector<float> areas;
};
SampleChoice chooseSamples(std::span<const SurfaceSample> samples, size_t count);

} // namespace hearth::visibility
