// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/pick_pass.h"

#include "runtime/gpu/scene/scene_tables.h"
#include "runtime/gpu/vulkan/image_barrier.h"
#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

namespace
{

constexpr uint32_t kPickTables[] = {shared::kTableVisible, shared::kTablePicks};

} // namespace

Result<PickPass> PickPass::create(const Device& device, const DrawLayouts& layouts, const Scene& scene)
{
    PickPass pass(device);
    HEARTH_ASSIGN_OR_RETURN(
        pass.picks_,
        pass.arena_.createBuffer(VkDeviceSize{shared::kMaxPicks} * sizeof(shared::Pick),
                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                 MemoryKind::device));
    const auto frames = static_cast<uint32_t>(scene.frames.size());
    HEARTH_ASSIGN_OR_RETURN(pass.pool_, createDescriptorPool(device, frames, {.storages = 2 * frames}));
    HEARTH_ASSIGN_OR_RETURN(pass.pipeline_,
                            createTablePipeline(device, shaders::find_picks_comp, kPickTables,
                                                sizeof(shared::PickPush),
                                                NumberedSet{shared::kSetPickPixels, layouts.pixels.get()}));
    for (uint32_t number = 0; number < frames; ++number)
    {
        HEARTH_ASSIGN_OR_RETURN(const VkDescriptorSet set,
                                allocateSet(device, pass.pool_.get(), pass.pipeline_.set_layout.get()));
        writeTables(device, mainView(scene, number), set, kPickTables);
        DescriptorWriter(set).storage(shared::kTablePicks, pass.picks_).write(device);
        pass.sets_.push_back(set);
    }
    return pass;
}

void PickPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                      const FrameTargets& targets, VkRect2D pixels, VkBuffer destination,
                      VkDeviceSize offset) const
{
    HEARTH_ASSERT(targets.options().keeps_visibility);
    const uint32_t count = pixels.extent.width * pixels.extent.height;
    HEARTH_ASSERT(count <= shared::kMaxPicks);
    constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    constexpr VkPipelineStageFlags kTransfer = VK_PIPELINE_STAGE_TRANSFER_BIT;
    // waits for the frame, and for the copy of earlier picks
    transition(device, commands, targets.visibility(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
               VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_SHADER_WRITE_BIT,
               VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT,
               VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT | kCompute | kTransfer, kCompute);
    barrier(device, commands, kCompute | kTransfer, VK_ACCESS_SHADER_WRITE_BIT, kCompute,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
    const VkDescriptorSet sets[] = {sets_[scene.tables->frame], targets.pixelSet()};
    const shared::PickPush push{static_cast<uint32_t>(pixels.offset.x),
                                static_cast<uint32_t>(pixels.offset.y), pixels.extent.width,
                                pixels.extent.height};
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.pipeline.get());
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.layout.get(),
                                      shared::kSetTables, 2, sets, 0, nullptr);
    device.vk.vkCmdPushConstants(commands, pipeline_.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                 sizeof(push), &push);
    device.vk.vkCmdDispatch(commands, (count + shared::kGroupPicks - 1) / shared::kGroupPicks, 1, 1);
    transition(device, commands, targets.visibility(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 0, VK_ACCESS_TRANSFER_READ_BIT, kCompute, kTransfer);
    barrier(device, commands, kCompute, VK_ACCESS_SHADER_WRITE_BIT, kTransfer, VK_ACCESS_TRANSFER_READ_BIT);
    const VkBufferCopy region{0, offset, count * VkDeviceSize{sizeof(shared::Pick)}};
    device.vk.vkCmdCopyBuffer(commands, picks_.handle.get(), destination, 1, &region);
    barrier(device, commands, kTransfer, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT,
            VK_ACCESS_HOST_READ_BIT);
}

} // namespace hearth::gpu
