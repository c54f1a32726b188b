// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/frame_update.h"

namespace hearth::gpu
{

namespace
{

/// Wait for everything that still reads the constants and counters of the view before.
void barrierBeforeUpdates(const Device& device, VkCommandBuffer commands)
{
    barrier(device, commands,
            VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT |
                VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
            VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_SHADER_WRITE_BIT,
            VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
            VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_SHADER_WRITE_BIT);
}

void barrierAfterUpdates(const Device& device, VkCommandBuffer commands)
{
    barrier(device, commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
            VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
            VK_ACCESS_UNIFORM_READ_BIT | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
}

void writeView(const Device& device, VkCommandBuffer commands, const Scene& scene,
               const FrameTargets& targets, const shared::FrameView& view)
{
    device.vk.vkCmdUpdateBuffer(commands, scene.buffers.frame.handle.get(), 0, sizeof(view), &view);
    const shared::OcclusionView views[] = {targets.pyramidView(), shared::makeOcclusionView(view)};
    device.vk.vkCmdUpdateBuffer(commands, targets.occlusionViews().handle.get(), 0, sizeof(views), views);
    device.vk.vkCmdFillBuffer(commands, scene.buffers.material_draws.handle.get(), 0, VK_WHOLE_SIZE, 0);
}

} // namespace

void recordFrameUpdate(const Device& device, VkCommandBuffer commands, const Scene& scene,
                       const FrameTargets& targets, const shared::FrameView& view,
                       const FrameChanges& changes)
{
    barrierBeforeUpdates(device, commands);
    writeView(device, commands, scene, targets, view);
    recordMoves(device, commands, scene, changes.moves);
    recordPoses(device, commands, scene, changes.poses);
    recordLights(device, commands, scene, changes.lights);
    if (scene.stream != nullptr)
        scene.stream->recordChanges(commands, scene.buffers);
    barrierAfterUpdates(device, commands);
}

void recordViewChange(const Device& device, VkCommandBuffer commands, const Scene& scene,
                      const FrameTargets& targets, const shared::FrameView& view)
{
    barrierBeforeUpdates(device, commands);
    writeView(device, commands, scene, targets, view);
    barrierAfterUpdates(device, commands);
}

} // namespace hearth::gpu
