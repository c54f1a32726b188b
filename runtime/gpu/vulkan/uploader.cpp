// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/uploader.h"

#include "runtime/gpu/vulkan/image_barrier.h"
#include "runtime/gpu/vulkan/pipelines.h"

#include <algorithm>
#include <cstring>

namespace hearth::gpu
{

Result<std::span<std::byte>> Uploader::stage(const Buffer& target, VkDeviceSize size)
{
    HEARTH_ASSERT(size > 0 && size <= target.size);
    HEARTH_ASSIGN_OR_RETURN(Buffer staging,
                            arena_.createBuffer(size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::staging));
    const VkBufferCopy region{0, 0, size};
    device_.vk.vkCmdCopyBuffer(commands_, staging.handle.get(), target.handle.get(), 1, &region);
    const std::span<std::byte> mapped(staging.mapped, static_cast<size_t>(size));
    buffers_.push_back(std::move(staging));
    return mapped;
}

Status Uploader::upload(const Buffer& target, std::span<const std::byte> bytes)
{
    if (bytes.empty())
        return success();
    HEARTH_ASSIGN_OR_RETURN(const std::span<std::byte> mapped, stage(target, bytes.size()));
    std::memcpy(mapped.data(), bytes.data(), bytes.size());
    return success();
}

Status Uploader::upload(const Image& target, std::span<const std::byte> texels, const TexelBlock& block)
{
    HEARTH_ASSIGN_OR_RETURN(
        Buffer staging,
        arena_.createBuffer(texels.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::staging));
    std::memcpy(staging.mapped, texels.data(), texels.size());
    std::vector<VkBufferImageCopy> regions;
    VkDeviceSize offset = 0;
    for (uint32_t mip = 0; mip < target.mip_count; ++mip)
    {
        const VkExtent3D extent{std::max(1u, target.extent.width >> mip),
                                std::max(1u, target.extent.height >> mip), 1};
        // the mip's own extent, even where its last blocks are not whole
        regions.push_back(
            {offset, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, mip, 0, target.layer_count}, {0, 0, 0}, extent});
        const VkDeviceSize columns = (extent.width + block.width - 1) / block.width;
        const VkDeviceSize rows = (extent.height + block.height - 1) / block.height;
        offset += columns * rows * block.bytes * target.layer_count;
    }
    HEARTH_ASSERT(offset == texels.size());
    transition(device_, commands_, target, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0,
               VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
               VK_PIPELINE_STAGE_TRANSFER_BIT);
    device_.vk.vkCmdCopyBufferToImage(commands_, staging.handle.get(), target.handle.get(),
                                      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                      static_cast<uint32_t>(regions.size()), regions.data());
    transition(device_, commands_, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_TRANSFER_WRITE_BIT,
               VK_ACCESS_SHADER_READ_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
               VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT);
    buffers_.push_back(std::move(staging));
    return success();
}

void Uploader::finish()
{
    barrier(device_, commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
            VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_UNIFORM_READ_BIT);
}

} // namespace hearth::gpu
