// Deformed instances of a scene on the device: the poses, which frames update, and the scratch buffer for
// skinned vertices. See runtime/gpu/README.md, "Characters".
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
    /// Bytes for the vertices of visible deformed clusters, which are skinned once per frame: 36 for a vertex
    /// with a normal and a tangent. Clusters that do not fit are skinned on demand, with the same result.
    uint64_t scratch_bytes = uint64_t{16} << 20;
};

/// Deformation data of a scene that has deformed meshes.
struct SceneDeformation
{
    DeformationLayout layout; ///< without the words, which are in the buffer
    uint32_t first_bin = 0;   ///< first bin of deformed instances; they are the last bins of the scene
    uint32_t rigid_items = 0; ///< first items of the work list
    uint32_t rigid_group_items = 0;
    /// Slice shared::kDeformationSlice of the geometry pool; starts with a shared::DeformationHeader.
    Buffer buffer;
    PoseRows rows;                             ///< of the pose that is being recorded
    VkDescriptorSet plan_set = VK_NULL_HANDLE; ///< skinning pass
    VkDescriptorSet cull_set = VK_NULL_HANDLE; ///< culling pass over deformed clusters
    VkDescriptorSet page_request_set = VK_NULL_HANDLE;
};

/// Check a pose: palette and weights must have the lengths of the instance's mesh and be finite. errors:
/// usage.
Status checkPose(const Scene& scene, const InstancePose& pose);

/// Record three copies per pose, and one more for every 64 KiB of its palette. Ignores poses that checkPose
/// rejects: the instance stays as it is. The caller puts barriers around: after all reads of the tables, and
/// before the reads that need the new poses.
void recordPoses(const Device& device, VkCommandBuffer commands, const Scene& scene,
                 std::span<const InstancePose> poses);

} // namespace hearth::gpu
