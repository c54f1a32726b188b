// Fits the samples of a mesh on its levels or on its proxy, and encodes visibility at the vertices of all
// levels. See cook/visibility/README.md, "From samples to vertices" and "Proxies".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/level_fit.h"
#include "cook/visibility/fit/refined_levels.h"
#include "cook/visibility/rays/sampled_moments.h"
#include "cook/visibility/scene/level_meshes.h"
#include "cook/visibility/scene/source_normals.h"

#include <optional>
#include <span>
#include <vector>

namespace hearth::visibility
{

/// Mesh with samples of its surface.
struct SampledMesh
{
    std::span<const LevelArrays> levels; ///< all, finest first
    /// that samples lie on: coarser levels are fitted, too, finer ones are interpolated
    size_t sampled_level = 0;
    /// surface that is fitted instead, all levels being interpolated; null: none
    const LevelArrays* proxy = nullptr;
    bool has_samples_on_proxy = false; ///< and not on a level
    std::span<const SurfaceSample> samples;
    const SampledMoments& seen;   ///< by the samples
    const SourceNormals& normals; ///< of the mesh
};

struct MeshFitStatistics
{
    FitMeshStatistics fit_mesh;        ///< of the sampled level, or of the proxy
    uint32_t iterations = 0;           ///< most of all fitted levels
    double condition = 0;              ///< largest of all fitted levels
    bool converged = true;             ///< on all of them
    uint64_t vertices = 0;             ///< of their fit meshes
    uint64_t clamped = 0;              ///< vertices whose fit was no valid visibility
    uint64_t unseen = 0;               ///< vertices of connected components without samples
    std::optional<RefineGain> refined; ///< if requested
    /// Rms error of ambient occlusion at the vertices that samples are fitted to, by the choice of samples
    /// and rays.
    std::optional<double> ao_error;
};

struct MeshFit
{
    /// Codes (encodeVisibility) of the vertices of each level; equal for vertices that several levels have.
    std::vector<std::vector<uint32_t>> codes;
    MeshFitStatistics statistics;
};

struct MeshFitSettings
{
    LevelFitSettings levels;
    bool refine_cones = false;   ///< fit cones to nine harmonics instead of four moments: refined_levels.h
    bool estimate_error = false; ///< fill MeshFitStatistics::ao_error, which takes two more fits
};

/// Fit a mesh. The same bits for any number of threads.
MeshFit fitMesh(const SampledMesh& mesh, const MeshFitSettings& settings);

} // namespace hearth::visibility
