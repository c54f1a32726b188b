// The scene: nodes, and what stands in them: instances of meshes, cameras, lights and shadow spheres.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf_accessors.h"
#include "pipelines/import/gltf_skins.h"
#include "pipelines/import/gltf_vertices.h"

namespace hearth::import
{

/// What the scene must know of a mesh that was read.
struct MeshSummary
{
    bool has_triangles = false;
    std::vector<bool> used_joints;
    size_t morph_target_count = 0;
    uint32_t posed_by = formats::kNone; ///< the node whose pose the vertices have, in the space of the scene
};

/// Write all nodes, and the instances, cameras and lights of the default scene (the first one, or without scenes
/// all nodes). errors: gltf_value, gltf_data, input_too_large.
/// `hidden` are nodes whose contents are not drawn.
Status writeScene(const GltfModel& model, std::span<const MeshSummary> meshes,
                  const std::vector<bool>& hidden, std::span<const InverseBinds> inverse_binds,
                  GltfAccessors& accessors, const GltfContext& context, GltfTally& tally);

/// The morph weights of a node with a mesh: its own, or else the mesh's; `count` of them, missing ones 0.
std::vector<float> morphWeights(const GltfModel& model, uint32_t node, size_t count);

/// The weights that a mesh is drawn with: those of the first node that has it, or its own where none has.
std::vector<float> restWeights(const GltfModel& model, uint32_t mesh);

} // namespace hearth::import
