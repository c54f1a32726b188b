// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/frame_ring.h"

#include "runtime/viewer/window/swapchain.h"

#include <algorithm>

namespace hearth::viewer
{

using gpu::vulkanError;

Result<std::unique_ptr<FrameRing>> FrameRing::create(const VulkanHost& host, const gpu::Device& device,
                                                     const WindowTable& vk)
{
    std::unique_ptr<FrameRing> ring(new FrameRing(host, device, vk));
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = host.queueFamily();
    HEARTH_TRY_VK(vk.vkCreateCommandPool(ring->device_, &pool, nullptr, &ring->pool_),
                  "create a command pool");
    const VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr,
                                               ring->pool_, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, VK_FENCE_CREATE_SIGNALED_BIT};
    const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, nullptr, 0};
    for (Slot& slot : ring->slots_)
    {
        HEARTH_TRY_VK(vk.vkAllocateCommandBuffers(ring->device_, &commands, &slot.commands),
                      "allocate a command buffer");
        HEARTH_TRY_VK(vk.vkCreateFence(ring->device_, &fence, nullptr, &slot.done), "create a fence");
        HEARTH_TRY_VK(vk.vkCreateSemaphore(ring->device_, &semaphore, nullptr, &slot.available),
                      "create a semaphore");
    }
    return ring;
}

FrameRing::~FrameRing()
{
    for (const Slot& slot : slots_)
    {
        if (slot.done != VK_NULL_HANDLE)
            vk_.vkDestroyFence(device_, slot.done, nullptr);
        if (slot.available != VK_NULL_HANDLE)
            vk_.vkDestroySemaphore(device_, slot.available, nullptr);
    }
    if (pool_ != VK_NULL_HANDLE)
        vk_.vkDestroyCommandPool(device_, pool_, nullptr);
}

Status FrameRing::wait()
{
    HEARTH_TRY_VK(vk_.vkWaitForFences(device_, 1, &slots_[slot()].done, VK_TRUE, UINT64_MAX),
                  "wait for a frame");
    // frames of one queue complete in order
    const uint64_t next = serial_ + 1;
    if (next > kFramesInFlight)
        completed_serial_ = std::max(completed_serial_, next - kFramesInFlight);
    return success();
}

Result<VkCommandBuffer> FrameRing::begin()
{
    const VkCommandBuffer commands = slots_[slot()].commands;
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr,
                                         VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
    HEARTH_TRY_VK(vk_.vkBeginCommandBuffer(commands, &begin), "begin a command buffer");
    return commands;
}

Status FrameRing::submit(VkSemaphore drawn)
{
    const Slot& slot = slots_[this->slot()];
    HEARTH_TRY_VK(vk_.vkEndCommandBuffer(slot.commands), "end a command buffer");
    HEARTH_TRY_VK(vk_.vkResetFences(device_, 1, &slot.done), "reset a fence");
    const VkPipelineStageFlags stage = kImageWait;
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.waitSemaphoreCount = 1;
    submit.pWaitSemaphores = &slot.available;
    submit.pWaitDstStageMask = &stage;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &slot.commands;
    submit.signalSemaphoreCount = 1;
    submit.pSignalSemaphores = &drawn;
    HEARTH_TRY_VK(vk_.vkQueueSubmit(host_.queue(), 1, &submit, slot.done), "draw a frame");
    ++serial_;
    return success();
}

Status FrameRing::waitForAll()
{
    HEARTH_TRY_VK(vk_.vkDeviceWaitIdle(device_), "wait for the frames");
    completed_serial_ = serial_;
    return success();
}

} // namespace hearth::viewer
