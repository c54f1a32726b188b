// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/image_barrier.h"

namespace hearth::gpu
{

void transition(const Device& device, VkCommandBuffer commands, const Image& image, VkImageLayout from,
                VkImageLayout to, VkAccessFlags written, VkAccessFlags read, VkPipelineStageFlags from_stage,
                VkPipelineStageFlags to_stage)
{
    VkImageMemoryBarrier info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    info.srcAccessMask = written;
    info.dstAccessMask = read;
    info.oldLayout = from;
    info.newLayout = to;
    info.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    info.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    info.image = image.handle.get();
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, image.mip_count, 0, image.layer_count};
    device.vk.vkCmdPipelineBarrier(commands, from_stage, to_stage, 0, 0, nullptr, 0, nullptr, 1, &info);
}

} // namespace hearth::gpu
