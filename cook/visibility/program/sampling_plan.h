// Chooses for each mesh the level that is sampled and fitted, and the number of its samples and rays, within
// a budget of rays. See cook/visibility/README.md, "The budget".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace hearth::visibility
{

struct SamplingSettings
{
    double samples_per_vertex = 8; ///< of meshes that the budget suffices for
    uint32_t rays_per_sample = 64; ///< best a power of two
    /// Rays of all meshes together: the larger one of the two, where the second is multiplied by the number
    /// of triangles.
    double max_rays = std::numeric_limits<double>::infinity();
    double max_rays_per_triangle = std::numeric_limits<double>::infinity();
};

struct MeshSampling
{
    uint32_t level = 0; ///< that samples lie on and that occludes, 0 the finest
    double samples_per_vertex = 0;
    uint32_t rays_per_sample = 0;
};

/// Distribute the budget: all rays that `settings` ask for go to the meshes up to a size; those of larger
/// meshes grow with the square root of their triangles. A mesh that gets fewer takes its rays on a level
/// that has about enough of them.
/// A mesh and its copies count as one mesh with the triangles of all.
/// triangles  of the levels of each mesh, finest first; empty for a mesh that is not baked
/// weights    of each mesh, greater than 0; those of larger meshes are multiplied by it. Empty: all are 1
/// originals  of each mesh, the one that it is a copy of, or itself; empty: no copies
/// returns    one for each mesh
std::vector<MeshSampling> planSampling(std::span<const std::vector<uint64_t>> triangles,
                                       const SamplingSettings& settings,
                                       std::span<const uint32_t> originals = {},
                                       std::span<const double> weights = {});

} // namespace hearth::visibility
