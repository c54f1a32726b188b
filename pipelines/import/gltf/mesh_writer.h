// Writes the meshes of a glTF file, each with its skin, their proxies and their levels of detail.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/lods.h"
#include "pipelines/import/gltf/meshes.h"
#include "pipelines/import/gltf/proxies.h"
#include "pipelines/import/gltf/scene.h"

namespace hearth::import
{

/// Read and write the meshes of `uses` one by one, so that only one is in memory at a time, with its proxies.
/// A mesh that is drawn only as a level of others, or that is only a proxy, is empty at its own index. Levels
/// follow after all meshes. Levels and proxies are transformed into the space of the mesh that they belong
/// to.
/// returns   for each mesh, without these levels, the properties that the scene needs
/// errors    those of GltfMeshReader::read and PartBuilder::addMesh
Result<std::vector<MeshSummary>>
writeMeshes(const GltfModel& model, const MeshUses& uses, const GltfLods& lods, const GltfProxies& proxies,
            GltfMeshReader& reader, std::span<const InverseBinds> inverse_binds, const GltfContext& context);

} // namespace hearth::import
