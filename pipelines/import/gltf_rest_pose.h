// Where a skinned mesh stands in the rest pose, as it is drawn until skins are cooked.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf_skins.h"

namespace hearth::import
{

/// The transform of every node to the space of the scene.
std::vector<Transform> worldTransforms(const GltfModel& model);

struct SkinnedRestPose
{
    Transform world_from_object;
    bool rigid = false; ///< all joints move the mesh alike: the rest pose is this transform of the bind pose
};

/// Where the joints carry a mesh, by those that it uses; nothing where it uses none, or only joints that shrink it
/// to nothing. `used` may not be longer than the skin (asserted).
std::optional<SkinnedRestPose> skinnedRestPose(const GltfSkin& skin, const InverseBinds& inverse_binds,
                                               const std::vector<bool>& used,
                                               std::span<const Transform> world_from_node);

/// Move the vertices to where the joints carry each of them, in the space of the scene (glTF 2.0, 3.7.3.3), and keep
/// what they were as the bind pose. False, and nothing done, where a position does not fit 32-bit numbers.
bool applyRestPose(mesh::SourceMesh& mesh, const GltfSkin& skin, const InverseBinds& inverse_binds,
                   std::span<const Transform> world_from_node);

} // namespace hearth::import
