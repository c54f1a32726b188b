// Skins: which nodes move which mesh, and where a skinned mesh stands in the rest pose.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf_accessors.h"

namespace hearth::import
{

/// The inverse bind matrices of one skin, one for each joint.
using InverseBinds = std::vector<Transform>;

/// Write all skins to the part and return their matrices. errors: gltf_value, gltf_data.
Result<std::vector<InverseBinds>> writeSkins(const GltfModel& model, GltfAccessors& accessors,
                                             const GltfContext& context);

struct SkinnedRestPose
{
    Transform world_from_object;
    bool exact =
        false; ///< all joints move the mesh alike, so that the rest pose is this transform of the bind pose
};

/// Where the bind pose of a mesh belongs, by the joints that it uses; nothing where it uses none, or only joints
/// that shrink it to nothing. `used` may not be longer than the skin (asserted).
std::optional<SkinnedRestPose> skinnedRestPose(const GltfSkin& skin, const InverseBinds& inverse_binds,
                                               const std::vector<bool>& used,
                                               std::span<const Transform> world_from_node);

} // namespace hearth::import
