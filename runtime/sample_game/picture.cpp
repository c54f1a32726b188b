// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "picture.h"

#include <png.h>

namespace game
{

Picture::Picture(Gpu& gpu, uint32_t width, uint32_t height)
    : width_(width),
      height_(height),
      buffer_(gpu.createBuffer(VkDeviceSize{4} * width * height, VK_BUFFER_USAGE_TRANSFER_DST_BIT))
{
}

void Picture::record(VkCommandBuffer commands, VkImage image)
{
    const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                   .imageExtent = {width_, height_, 1}};
    vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer_.buffer, 1, &region);
    const VkMemoryBarrier barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                  .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                  .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier,
                         0, nullptr, 0, nullptr);
}

void Picture::write(const std::string& path) const
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width_;
    image.height = height_;
    image.format = PNG_FORMAT_RGBA;
    check(png_image_write_to_file(&image, path.c_str(), 0, buffer_.mapped, 0, nullptr) != 0,
          path + ": " + image.message);
}

} // namespace game
