// Averages the moments of a mesh's samples over the placements of the mesh: its instances or its poses.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/rays/rays.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hearth::visibility
{

/// Placement of a mesh among occluders.
struct Placement
{
    const Occluders* occluders = nullptr; ///< finished
    Affine3 world_from_mesh;
    /// Positions of the mesh in a pose, in its own space; empty: no pose. Moments in a pose are rotated back
    /// with each triangle.
    std::vector<Float3> posed_positions;
};

struct SampledMoments
{
    std::vector<Moments> moments;      ///< one for each sample, in the space of the mesh
    std::vector<SecondMoments> second; ///< empty unless requested
    std::vector<uint8_t> interior;     ///< 1: interior, closely covered in all places and never visible
    uint64_t rays = 0;
    /// Rms difference of ambient occlusion between the places and their mean, over the surface: how unlike
    /// the places are. 0 for one place.
    double spread = 0;
};

/// Progress callback: finished rays of a place. Returns false to stop.
using PlacementProgress = std::function<bool(size_t place, uint64_t rays_done, uint64_t rays_total)>;

/// Compute the mean over the places. Each place takes the next settings.rays_per_sample rays of each sample's
/// sequence.
/// returns  nothing if `progress` returned false
std::optional<SampledMoments> sampledMoments(const MeshView& mesh, std::span<const SurfaceSample> samples,
                                             std::span<const Placement> places, RaySettings settings,
                                             bool with_second, const PlacementProgress& progress);

} // namespace hearth::visibility
