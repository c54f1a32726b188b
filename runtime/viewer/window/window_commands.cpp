// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/window_commands.h"

#include "runtime/gpu/vulkan/pipelines.h"

namespace hearth::viewer
{

namespace
{

constexpr VkPipelineStageFlags kTransfer = VK_PIPELINE_STAGE_TRANSFER_BIT;

void transition(const gpu::Device& device, VkCommandBuffer commands, VkImage image,
                const gpu::ImageState& from, const gpu::ImageState& to)
{
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = from.access;
    barrier.dstAccessMask = to.access;
    barrier.oldLayout = from.layout;
    barrier.newLayout = to.layout;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    device.vk.vkCmdPipelineBarrier(commands, from.stages, to.stages, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

constexpr gpu::ImageState kCopied{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, kTransfer,
                                  VK_ACCESS_TRANSFER_READ_BIT};

} // namespace

void recordReadback(const gpu::Device& device, const WindowTable& vk, VkCommandBuffer commands,
                    VkImage window, VkExtent2D extent, const gpu::Buffer& target)
{
    transition(device, commands, window, kDrawnImage, kCopied);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {extent.width, extent.height, 1};
    vk.vkCmdCopyImageToBuffer(commands, window, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.handle.get(), 1,
                              &region);
    gpu::barrier(device, commands, kTransfer, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                 VK_ACCESS_HOST_READ_BIT);
    transition(device, commands, window, kCopied, kDrawnImage);
}

void recordPresentable(const gpu::Device& device, VkCommandBuffer commands, VkImage window)
{
    transition(device, commands, window, kDrawnImage,
               {VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0});
}

} // namespace hearth::viewer
