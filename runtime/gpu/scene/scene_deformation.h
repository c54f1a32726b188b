// The deformed instances of a scene on the device: their poses, which frames bring, and the scratch for their vertices.
// See runtime/gpu/README.md, "Characters".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/deformation_layout.h"
#include "runtime/gpu/vulkan/memory.h"

#include <span>

namespace hearth::gpu
{

struct Scene;

struct DeformationOptions
{
    /// Bytes for the vertices of visible deformed clusters, which are skinned once a frame: 36 for a vertex with a
    /// normal and a tangent. What does not fit is skinned wherever it is needed, with the same picture.
    uint64_t scratch_bytes = uint64_t{16} << 20;
};

/// Of a scene that has deformed meshes.
struct SceneDeformation
{
    DeformationLayout layout; ///< without the words, which the buffer has
    uint32_t first_bin = 0;   ///< of the scene's bins: from here on they are those of deformed instances
    uint32_t rigid_items = 0; ///< of the work list: the first ones
    uint32_t rigid_group_items = 0;
    Buffer
        buffer; ///< slice shared::kDeformationSlice of the geometry pool; starts with a shared::DeformationHeader
    PosedRows rows;                            ///< of the pose that is being recorded
    VkDescriptorSet plan_set = VK_NULL_HANDLE; ///< of the skinning pass
    VkDescriptorSet cull_set = VK_NULL_HANDLE; ///< of the pass over the clusters
    VkDescriptorSet page_request_set = VK_NULL_HANDLE;
};

/// What of a pose is wrong. Palette and weights are as long as the instance's mesh says, and finite.
/// errors: usage.
Status checkPose(const Scene& scene, const InstancePose& pose);

/// Three copies for each, and as many more as its palette has 64 KiB. What checkPose refuses is left out: the instance
/// stays as it is. Between barriers of the caller: after all that reads the tables, before what shall see the new ones.
void recordPoses(const Device& device, VkCommandBuffer commands, const Scene& scene,
                 std::span<const InstancePose> poses);

} // namespace hearth::gpu
