// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/window_commands.h"

#include "runtime/gpu/vulkan/pipelines.h"

namespace hearth::viewer
{

namespace
{

constexpr VkPipelineStageFlags kTransfer = VK_PIPELINE_STAGE_TRANSFER_BIT;

struct ImageAccess
{
    VkPipelineStageFlags stage;
    VkAccessFlags access;
    VkImageLayout layout;
};

void transition(const gpu::Device& device, VkCommandBuffer commands, VkImage image, const ImageAccess& from,
                const ImageAccess& to)
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
    device.vk.vkCmdPipelineBarrier(commands, from.stage, to.stage, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

constexpr ImageAccess kTransferWrite{kTransfer, VK_ACCESS_TRANSFER_WRITE_BIT,
                                     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
constexpr ImageAccess kTransferRead{kTransfer, VK_ACCESS_TRANSFER_READ_BIT,
                                    VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};

} // namespace

void recordImage(const gpu::Device& device, const WindowTable& vk, VkCommandBuffer commands,
                 const gpu::FrameTargets& targets, VkImage window)
{
    transition(device, commands, window, {kTransfer, 0, VK_IMAGE_LAYOUT_UNDEFINED}, kTransferWrite);
    // texel by texel: a blit converts the order of channels to the window's, which a copy would not
    const VkExtent2D extent = targets.outputExtent();
    const VkOffset3D corner{static_cast<int32_t>(extent.width), static_cast<int32_t>(extent.height), 1};
    const VkImageSubresourceLayers color{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    const VkImageBlit region{color, {{}, corner}, color, {{}, corner}};
    vk.vkCmdBlitImage(commands, targets.color().handle.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, window,
                      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_NEAREST);
}

void recordWithoutOverlay(const gpu::Device& device, VkCommandBuffer commands, VkImage window)
{
    transition(device, commands, window, kTransferWrite, kTransferRead);
}

void recordReadback(const gpu::Device& device, const WindowTable& vk, VkCommandBuffer commands,
                    VkImage window, VkExtent2D extent, const gpu::Buffer& target)
{
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {extent.width, extent.height, 1};
    vk.vkCmdCopyImageToBuffer(commands, window, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.handle.get(), 1,
                              &region);
    gpu::barrier(device, commands, kTransfer, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                 VK_ACCESS_HOST_READ_BIT);
}

void recordPresentable(const gpu::Device& device, VkCommandBuffer commands, VkImage window)
{
    transition(device, commands, window, kTransferRead,
               {VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR});
}

} // namespace hearth::viewer
