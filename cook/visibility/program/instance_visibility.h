// Measures how unlike the instances of a mesh are, and fits each one's visibility to its own surroundings.
// See cook/visibility/README.md, "Visibility of instances".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/program/instance_samples.h"
#include "cook/visibility/rays/rays.h"
#include "formats/base/affine3d.h"
#include "formats/gpu_shared/visibility_cone.h"
#include "formats/records/surroundings.h"

#include <span>

namespace hearth::visibility
{

/// Unlikeness of the instances of a mesh: rms differences of ambient occlusion from what the instances see,
/// over the surfaces of all, without the noise of rays.
struct InstanceSpread
{
    double of_mean = 0;      ///< with the mean visibility of the mesh
    double with_factors = 0; ///< with the factors of the instances that have one
    uint32_t changed_instances = 0;
    uint64_t rays = 0;
};

/// Transform moments from the space of a mesh into the world of an instance, as shading does: m1 keeps its
/// length.
shared::VisibilityMoments placeMoments(const Moments& moments, const Affine3d& mesh_from_world);

/// Fit a factor to each instance, or to groups of neighbours where there are too many for the rays. Instances
/// whose error falls by next to nothing keep the mean of their mesh. The same for any number of threads.
/// world      finished
/// surface    moments are those of all instances together
/// instances  at least two
/// max_rays   of all instances together
/// settings   of the mesh's own rays, apart from their number
/// records    of the scene's instances; those of the mesh get their factors
InstanceSpread fitInstances(const Occluders& world, const SampledSurface& surface,
                            std::span<const MeshInstance> instances, double max_rays, RaySettings settings,
                            std::span<formats::SurroundingsRecord> records);

} // namespace hearth::visibility
