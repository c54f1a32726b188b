// Writes the scene: nodes, and their contents: instances of meshes, cameras, lights and shadow spheres.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/accessors.h"
#include "pipelines/import/gltf/mesh_uses.h"
#include "pipelines/import/gltf/vertices.h"

namespace hearth::import
{

/// Properties of a mesh that the scene needs.
struct MeshSummary
{
    bool has_triangles = false;
    std::vector<bool> used_joints;
    SkinState skin = SkinState::idle; ///< usable: the mesh has joints and weights
    bool skin_mirrors = false;        ///< the joints mirror the mesh
    size_t morph_target_count = 0;
};

/// Write all nodes, and the instances, cameras and lights of the default scene (the first one, or without
/// scenes all nodes). errors: gltf_extension_value, gltf_data, number_too_large, input_too_large.
/// meshes  for each mesh of `uses`
/// hidden  nodes whose contents are not drawn
Status writeScene(const GltfModel& model, const MeshUses& uses, std::span<const MeshSummary> meshes,
                  const std::vector<bool>& hidden, GltfAccessors& accessors, const GltfContext& context,
                  GltfTally& tally);

/// Return the morph weights of a node with a mesh: the node's own, or else the mesh's; `count` weights,
/// missing ones 0.
std::vector<float> morphWeights(const GltfModel& model, uint32_t node, size_t count);

} // namespace hearth::import
