// Writes the meshes of a glTF file, each with its skin, and their levels of detail.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/lods.h"
#include "pipelines/import/gltf/meshes.h"
#include "pipelines/import/gltf/scene.h"

namespace hearth::import
{

/// Read and write the meshes of `uses` one by one, so that one at a time is in memory. A mesh that is drawn as a level of others
/// alone is empty in its place; levels follow behind all meshes, moved to where the mesh stands that they are levels of.
/// returns   what the scene must know of each mesh, without those levels
/// errors    those of GltfMeshReader::read and PartBuilder::addMesh
Result<std::vector<MeshSummary>> writeMeshes(const GltfModel& model, const MeshUses& uses,
                                             const GltfLods& lods, GltfMeshReader& reader,
                                             std::span<const InverseBinds> inverse_binds,
                                             const GltfContext& context);

} // namespace hearth::import
