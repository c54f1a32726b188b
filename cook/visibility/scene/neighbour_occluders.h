// Adds a neighbouring source to the occluders, farther instances at coarser levels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/rays/occluders.h"
#include "formats/pack/pack_view.h"

#include <span>

namespace hearth::visibility
{

/// Upper bound of the error of a neighbour's surface, as an angle in radians that it is seen under from the
/// source. A silhouette that is off by so much all around an occluder of angular radius a changes ambient
/// occlusion by at most 2 a / 256.
inline constexpr float kMaxNeighbourError = 1.0f / 256;

/// Return the distance between two boxes; 0 where they meet.
float distanceBetween(const Box3& a, const Box3& b);

/// Choose the level of a mesh's instance in a neighbour: the coarsest one whose error, seen from `distance`,
/// is at most kMaxNeighbourError, but none finer than `sampled_level`.
/// scale_max  of the instance: InstanceRecord::scale_max
uint32_t chooseNeighbourLevel(const formats::PackView& part, uint32_t mesh, float scale_max, float distance,
                              uint32_t sampled_level);

/// Add the instances of a neighbour at rest. Deformed meshes are left out: they move. So are instances that
/// are farther than `max_distance`.
/// scene, part     import and clusters part of the neighbour; checkHierarchy has accepted the second
/// sampled_levels  of the meshes: where the neighbour itself is sampled
/// receivers       box of the source whose visibility is baked, world space, not empty
/// errors: those of MeshPages::read and addMesh
Status addNeighbour(Occluders& occluders, const formats::PackView& scene, const formats::PackView& part,
                    std::span<const uint32_t> sampled_levels, const Box3& receivers, float max_distance);

} // namespace hearth::visibility
