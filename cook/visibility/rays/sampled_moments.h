// What the samples of a mesh see, averaged over the places that it stands in.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/rays/rays.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hearth::visibility
{

/// How a mesh stands among occluders.
struct Place
{
    const Occluders* occluders = nullptr; ///< finished
    Affine3 world_from_mesh;
    /// Positions of the mesh in a pose, in its own space; empty: as it is. What is seen then is turned back with each
    /// triangle.
    std::vector<Float3> posed;
};

struct SampledMoments
{
    std::vector<Moments> moments;      ///< one for each sample, in the space of the mesh
    std::vector<SecondMoments> second; ///< only where asked for
    std::vector<uint8_t> buried;       ///< 1: closely covered in all places, so that nobody looks at it
    uint64_t rays = 0;
};

/// Told rays done of a place; returns whether to go on.
using PlaceProgress = std::function<bool(size_t place, uint64_t rays_done, uint64_t rays_total)>;

/// The mean over the places, each of which takes settings.rays_per_sample rays of each sample, one after another of its
/// sequence.
/// returns  nothing where `progress` said to stop
std::optional<SampledMoments> sampledMoments(const MeshView& mesh, std::span<const SurfaceSample> samples,
                                             std::span<const Place> places, RaySettings settings,
                                             bool with_second, const PlaceProgress& progress);

} // namespace hearth::visibility
