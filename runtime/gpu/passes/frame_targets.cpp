// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/frame_targets.h"

#include "formats/gpu_shared/material_tiles.h"
#include "formats/gpu_shared/occlusion.h"

#include <string>

namespace hearth::gpu
{

namespace
{

Result<UniqueSampler> createTexelSampler(const Device& device)
{
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler sampler;
    HEARTH_TRY_VK(device.vk.vkCreateSampler(device.handle, &info, device.allocator, &sampler),
                  "create a sampler");
    return UniqueSampler(device, sampler);
}

} // namespace

Result<FrameTargets> FrameTargets::create(const Device& device, VkRenderPass render_pass,
                                          const DrawLayouts& layouts, VkExtent2D extent)
{
    if (extent.width > device.limits.maxFramebufferWidth ||
        extent.height > device.limits.maxFramebufferHeight ||
        std::max(extent.width, extent.height) > device.limits.maxImageDimension2D)
        return Error{Issue::device_limit, "", "",
                     "the device cannot render " + std::to_string(extent.width) + "x" +
                         std::to_string(extent.height) + " pixels"};
    FrameTargets t(device, extent);
    HEARTH_TRY(t.createImages());
    HEARTH_TRY(t.createFramebuffer(device, render_pass));
    HEARTH_TRY(t.createPyramid(device));
    HEARTH_TRY(t.createTileLists(device));
    HEARTH_TRY(t.createSets(device, layouts));
    return t;
}

Status FrameTargets::createImages()
{
    constexpr VkImageUsageFlags kColorUsage =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    constexpr VkImageUsageFlags kDepthUsage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    const auto create = [&](Image& image, FrameAttachment which, VkImageUsageFlags usage) -> Status
    {
        const bool depth = (usage & kDepthUsage) != 0;
        HEARTH_ASSIGN_OR_RETURN(
            image, arena_.createImage({.format = kAttachmentFormats[which],
                                       .extent = extent_,
                                       .usage = usage,
                                       .aspect = VkImageAspectFlags(depth ? VK_IMAGE_ASPECT_DEPTH_BIT
                                                                          : VK_IMAGE_ASPECT_COLOR_BIT)}));
        return success();
    };
    HEARTH_TRY(create(visibility_, kVisibility,
                      kColorUsage | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT));
    HEARTH_TRY(create(depth_, kDepth, kDepthUsage | VK_IMAGE_USAGE_SAMPLED_BIT));
    HEARTH_TRY(create(material_depth_, kMaterialDepth, kDepthUsage));
    return create(color_, kColor, kColorUsage);
}

Status FrameTargets::createFramebuffer(const Device& device, VkRenderPass render_pass)
{
    const VkImageView views[kAttachmentCount] = {visibility_.view.get(), depth_.view.get(),
                                                 material_depth_.view.get(), color_.view.get()};
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = render_pass;
    info.attachmentCount = kAttachmentCount;
    info.pAttachments = views;
    info.width = extent_.width;
    info.height = extent_.height;
    info.layers = 1;
    VkFramebuffer framebuffer;
    HEARTH_TRY_VK(device.vk.vkCreateFramebuffer(device.handle, &info, device.allocator, &framebuffer),
                  "create a framebuffer");
    framebuffer_ = UniqueFramebuffer(device, framebuffer);
    return success();
}

Status FrameTargets::createPyramid(const Device& device)
{
    const auto [width, height] = extent_;
    const uint64_t texels = shared::pyramidOffset(width, height, shared::pyramidLevels(width, height) + 1);
    if (texels * sizeof(float) > device.limits.maxStorageBufferRange)
        return Error{Issue::device_limit, "", "",
                     "the device cannot bind the depth pyramid of " + std::to_string(width) + "x" +
                         std::to_string(height) + " pixels"};
    HEARTH_ASSIGN_OR_RETURN(pyramid_, arena_.createBuffer(texels * sizeof(float),
                                                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                              VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                                              VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                          MemoryKind::device));
    HEARTH_ASSIGN_OR_RETURN(occlusion_views_, arena_.createBuffer(2 * sizeof(shared::OcclusionView),
                                                                  VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                                                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                                  MemoryKind::device));
    return success();
}

Status FrameTargets::createTileLists(const Device& device)
{
    constexpr VkBufferUsageFlags kUsage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    const uint64_t tiles =
        uint64_t{shared::materialTiles(extent_.width)} * shared::materialTiles(extent_.height);
    const uint64_t words = tiles * shared::kMaterialsPerTile + shared::kFirstTileEntry;
    if (words * sizeof(uint32_t) > device.limits.maxStorageBufferRange)
        return Error{Issue::device_limit, "", "",
                     "the device cannot bind the material tiles of " + std::to_string(extent_.width) + "x" +
                         std::to_string(extent_.height) + " pixels"};
    HEARTH_ASSIGN_OR_RETURN(tile_materials_,
                            arena_.createBuffer(tiles * shared::kMaterialsPerTile * sizeof(uint32_t), kUsage,
                                                MemoryKind::device));
    HEARTH_ASSIGN_OR_RETURN(tile_lists_,
                            arena_.createBuffer(words * sizeof(uint32_t), kUsage, MemoryKind::device));
    return success();
}

Status FrameTargets::createSets(const Device& device, const DrawLayouts& layouts)
{
    HEARTH_ASSIGN_OR_RETURN(texel_sampler_, createTexelSampler(device));
    HEARTH_ASSIGN_OR_RETURN(gather_, GatherTargets::create(device, layouts, arena_, extent_,
                                                           visibility_.view.get(), texel_sampler_.get()));
    const DescriptorPoolSizes sizes{.uniforms = 1, .storages = 4, .textures = 3, .inputs = 1};
    HEARTH_ASSIGN_OR_RETURN(pool_, createDescriptorPool(device, 3, sizes));
    HEARTH_ASSIGN_OR_RETURN(set_, allocateSet(device, pool_.get(), layouts.attachments.get()));
    DescriptorWriter(set_)
        .input(shared::kAttachmentVisibility, visibility_.view.get())
        .storage(shared::kAttachmentTileLists, tile_lists_)
        .texture(shared::kAttachmentGi, gather_->texels().view.get(), texel_sampler_.get())
        .write(device);
    HEARTH_ASSIGN_OR_RETURN(occlusion_set_, allocateSet(device, pool_.get(), layouts.occlusion.get()));
    DescriptorWriter(occlusion_set_)
        .uniform(shared::kOcclusionViews, occlusion_views_)
        .storage(shared::kOcclusionPyramid, pyramid_)
        .texture(shared::kOcclusionDepth, depth_.view.get(), texel_sampler_.get())
        .write(device);
    HEARTH_ASSIGN_OR_RETURN(tile_set_, allocateSet(device, pool_.get(), layouts.tiles.get()));
    DescriptorWriter(tile_set_)
        .texture(shared::kTilesVisibility, visibility_.view.get(), texel_sampler_.get())
        .storage(shared::kTilesMaterials, tile_materials_)
        .storage(shared::kTilesLists, tile_lists_)
        .write(device);
    return success();
}

} // namespace hearth::gpu
