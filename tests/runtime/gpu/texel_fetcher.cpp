// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/texel_fetcher.h"

#include "runtime/gpu/vulkan/image_barrier.h"
#include "runtime/gpu/vulkan/pipelines.h"
#include "runtime/gpu/vulkan/sampler.h"
#include "tests/runtime/shaders/test_shaders.h"

#include <cstring>

namespace hearth::test
{

Result<std::unique_ptr<TexelFetcher>> TexelFetcher::create()
{
    std::unique_ptr<TexelFetcher> fetcher(new TexelFetcher);
    HEARTH_ASSIGN_OR_RETURN(fetcher->host_,
                            viewer::VulkanHost::create({.device_name = "", .validate = true}));
    HEARTH_ASSIGN_OR_RETURN(fetcher->device_, gpu::makeDevice(fetcher->host_->description()));
    const gpu::Device& device = fetcher->device_;
    HEARTH_ASSIGN_OR_RETURN(fetcher->sampler_, gpu::createClampingSampler(device, VK_FILTER_NEAREST));
    const gpu::SetBinding bindings[] = {gpu::textureBinding(0, VK_SHADER_STAGE_COMPUTE_BIT),
                                        gpu::storageBinding(1, VK_SHADER_STAGE_COMPUTE_BIT)};
    HEARTH_ASSIGN_OR_RETURN(fetcher->set_layout_, gpu::createSetLayout(device, bindings));
    const gpu::NumberedSet sets[] = {{0, fetcher->set_layout_.get()}};
    HEARTH_ASSIGN_OR_RETURN(fetcher->pipeline_,
                            gpu::createComputePipeline(device, shaders::fetch_texels_comp, sets));
    return fetcher;
}

bool TexelFetcher::supports(const formats::TexelFormatTraits& traits) const
{
    VkFormatProperties properties{};
    device_.vk.vkGetPhysicalDeviceFormatProperties(host_->description().physical_device,
                                                   static_cast<VkFormat>(traits.vulkan_format), &properties);
    return (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) != 0;
}

Result<std::vector<std::array<float, 4>>> TexelFetcher::fetch(const formats::TexelFormatTraits& traits,
                                                              uint32_t width, uint32_t height,
                                                              std::span<const std::byte> blocks)
{
    HEARTH_ASSERT(blocks.size() == formats::mipBytes(traits, width, height));
    gpu::MemoryArena arena(device_);
    std::vector<std::array<float, 4>> texels(size_t{width} * height);
    HEARTH_ASSIGN_OR_RETURN(
        gpu::Buffer staging,
        arena.createBuffer(blocks.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::MemoryKind::staging));
    std::memcpy(staging.mapped, blocks.data(), blocks.size());
    HEARTH_ASSIGN_OR_RETURN(gpu::Buffer fetched, arena.createBuffer(texels.size() * sizeof(texels[0]),
                                                                    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                                        VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                                                    gpu::MemoryKind::device));
    HEARTH_ASSIGN_OR_RETURN(
        gpu::Image image,
        arena.createImage({.format = static_cast<VkFormat>(traits.vulkan_format),
                           .extent = {width, height},
                           .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT}));
    HEARTH_ASSIGN_OR_RETURN(const gpu::UniqueDescriptorPool pool,
                            gpu::createDescriptorPool(device_, 1, {.storages = 1, .textures = 1}));
    HEARTH_ASSIGN_OR_RETURN(const VkDescriptorSet set,
                            gpu::allocateSet(device_, pool.get(), set_layout_.get()));
    gpu::DescriptorWriter(set)
        .texture(0, image.view.get(), sampler_.get())
        .storage(1, fetched)
        .write(device_);
    HEARTH_TRY(host_->run(
        [&](VkCommandBuffer commands) -> Status
        {
            gpu::transition(device_, commands, image, VK_IMAGE_LAYOUT_UNDEFINED,
                            VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0, VK_ACCESS_TRANSFER_WRITE_BIT,
                            VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT);
            const VkBufferImageCopy region{
                0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {0, 0, 0}, {width, height, 1}};
            device_.vk.vkCmdCopyBufferToImage(commands, staging.handle.get(), image.handle.get(),
                                              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
            gpu::transition(device_, commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                            VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_TRANSFER_WRITE_BIT,
                            VK_ACCESS_SHADER_READ_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
                            VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
            device_.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.pipeline.get());
            device_.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                               pipeline_.layout.get(), 0, 1, &set, 0, nullptr);
            device_.vk.vkCmdDispatch(commands, (width + 7) / 8, (height + 7) / 8, 1);
            gpu::barrier(device_, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                         VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT);
            return success();
        }));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, host_->read(device_, fetched));
    std::memcpy(texels.data(), bytes.data(), texels.size() * sizeof(texels[0]));
    return texels;
}

} // namespace hearth::test
