// Chooses instances whose mesh is copied, since they see too different a part of the sky from others of the
// mesh. See cook/visibility/README.md, "Visibility of instances".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/program/baked_source.h"
#include "cook/visibility/rays/rays.h"

#include <cstdint>
#include <vector>

namespace hearth::visibility
{

/// Copies of meshes: instances with one have another visibility than those of the mesh.
struct MeshCopies
{
    std::vector<uint32_t> meshes; ///< that are copied, one for each copy
    /// Mesh of each instance of the scene; copies are numbered after all meshes.
    std::vector<uint32_t> instance_meshes;
};

/// Return whether any mesh has instances that are compared: several, but not thousands.
bool mayNeedCopies(const BakedSource& source, uint64_t max_bytes);

/// Choose the instances that gain the most for each byte that a copy takes: area by mean square error of the
/// ambient occlusion that they would have with their mesh's visibility and a factor. The same for any number
/// of threads.
/// source           without copies
/// world            finished
/// instance_meshes  mesh of each instance of the scene
/// max_bytes        of all copies
/// errors: those of MeshPages::read
Result<MeshCopies> chooseCopies(const BakedSource& source, const Occluders& world,
                                std::vector<uint32_t> instance_meshes, const RaySettings& rays,
                                const FitMeshSettings& fit_mesh, uint64_t max_bytes);

} // namespace hearth::visibility
