// Meshes that the instances of a source draw, where a clusters part has copies of meshes. See FORMAT.md,
// "Surroundings".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <cstdint>
#include <vector>

namespace hearth::formats
{

/// Return the mesh of the clusters part that each instance draws: that of chunk IMSH, or else its own.
/// errors: those of ContainerReader::records; meaning_reference for an instance of a mesh that the clusters
/// part does not have, and for a list of meshes that is not one of the scene's instances
Result<std::vector<uint32_t>> readInstanceMeshes(const PackView& scene, const PackView& clusters_part);

/// Return for each mesh of the clusters part the mesh of the source that it is, or is a copy of.
/// instance_meshes  of readInstanceMeshes
std::vector<uint32_t> findOriginalMeshes(const PackView& scene, std::span<const uint32_t> instance_meshes,
                                         size_t mesh_count);

} // namespace hearth::formats
