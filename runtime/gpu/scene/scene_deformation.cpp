// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/scene_deformation.h"

#include "runtime/gpu/scene/scene.h"
#include "runtime/gpu/scene/scene_shadows.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace hearth::gpu
{

namespace
{

bool isFinite(const InstancePose& pose)
{
    return std::all_of(pose.world_from_bind.begin(), pose.world_from_bind.end(),
                       [](const Affine3d& joint) { return narrowed(joint).has_value(); }) &&
           std::all_of(pose.morph_weights.begin(), pose.morph_weights.end(),
                       [](float weight) { return std::isfinite(weight); });
}

bool fits(const DeformedInstance& instance, const InstancePose& pose)
{
    return pose.world_from_bind.size() == instance.joint_count &&
           pose.morph_weights.size() == instance.target_count;
}

/// Record an update in pieces: vkCmdUpdateBuffer takes 64 KiB at once.
void recordUpdate(const Device& device, VkCommandBuffer commands, const Buffer& buffer, VkDeviceSize offset,
                  std::span<const std::byte> bytes)
{
    constexpr size_t kMaxBytes = 65536;
    for (size_t done = 0; done < bytes.size(); done += kMaxBytes)
    {
        const auto part = bytes.subspan(done, std::min(kMaxBytes, bytes.size() - done));
        device.vk.vkCmdUpdateBuffer(commands, buffer.handle.get(), offset + done, part.size(), part.data());
    }
}

template <typename Record>
void recordRow(const Device& device, VkCommandBuffer commands, const Buffer& table, uint32_t row,
               const Record& record)
{
    recordUpdate(device, commands, table, row * VkDeviceSize{sizeof(record)},
                 std::as_bytes(std::span(&record, 1)));
}

} // namespace

Status checkPose(const Scene& scene, const InstancePose& pose)
{
    const auto fail = [&](const std::string& detail) {
        return Error{Issue::usage, "", "instance " + std::to_string(pose.instance), detail};
    };
    const DeformedInstance* instance =
        scene.deformation == nullptr ? nullptr : findDeformed(scene.deformation->layout, pose.instance);
    if (instance == nullptr)
        return fail("it has no joints or morph targets that a pose could move");
    if (!fits(*instance, pose))
        return fail("its pose has " + std::to_string(pose.world_from_bind.size()) + " joints and " +
                    std::to_string(pose.morph_weights.size()) + " morph weights, its mesh " +
                    std::to_string(instance->joint_count) + " and " + std::to_string(instance->target_count));
    if (!isFinite(pose))
        return fail("its pose has numbers that are not finite or do not fit into single precision");
    return success();
}

void recordPoses(const Device& device, VkCommandBuffer commands, const Scene& scene,
                 std::span<const InstancePose> poses)
{
    if (scene.deformation == nullptr)
        return;
    SceneDeformation& deformation = *scene.deformation;
    for (const InstancePose& pose : poses)
    {
        const DeformedInstance* instance = findDeformed(deformation.layout, pose.instance);
        PoseRows& rows = deformation.rows;
        if (instance == nullptr || !fits(*instance, pose) || !poseInstance(*instance, pose, rows))
            continue;
        recordRow(device, commands, scene.buffers.instances, pose.instance, rows.record);
        recordRow(device, commands, scene.buffers.bounds, rows.record.mesh, rows.bounds);
        recordUpdate(device, commands, deformation.buffer, instance->pose_row * VkDeviceSize{16},
                     std::as_bytes(std::span(rows.words)));
        if (scene.shadows != nullptr)
            scene.shadows->pose(*instance, rows);
    }
}

} // namespace hearth::gpu
