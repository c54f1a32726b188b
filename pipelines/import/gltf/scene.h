// The scene: nodes, and what stands in them: instances of meshes, cameras, lights and shadow spheres.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/accessors.h"
#include "pipelines/import/gltf/mesh_uses.h"
#include "pipelines/import/gltf/vertices.h"

namespace hearth::import
{

/// What the scene must know of a mesh that was read.
struct MeshSummary
{
    bool has_triangles = false;
    std::vector<bool> used_joints;
    SkinState skin = SkinState::idle; ///< usable: the mesh has joints and weights
    bool skin_mirrors = false;        ///< the joints show the mesh's mirror image
    size_t morph_target_count = 0;
};

/// Write all nodes, and the instances, cameras and lights of the default scene (the first one, or without scenes
/// all nodes). errors: gltf_value, gltf_data, input_too_large.
/// `hidden` are nodes whose contents are not drawn.
/// `meshes` are those of `uses`.
Status writeScene(const GltfModel& model, const MeshUses& uses, std::span<const MeshSummary> meshes,
                  const std::vector<bool>& hidden, GltfAccessors& accessors, const GltfContext& context,
                  GltfTally& tally);

/// The morph weights of a node with a mesh: its own, or else the mesh's; `count` of them, missing ones 0.
std::vector<float> morphWeights(const GltfModel& model, uint32_t node, size_t count);

} // namespace hearth::import
