// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/frame_targets.h"

#include "formats/shared/occlusion.h"

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
    constexpr VkImageUsageFlags kColorUsage =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    constexpr VkImageUsageFlags kDepthUsage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    FrameTargets t(device);
    HEARTH_ASSIGN_OR_RETURN(
        t.visibility_, t.arena_.createImage({.format = kAttachmentFormats[kVisibility],
                                             .extent = extent,
                                             .usage = kColorUsage | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT}));
    HEARTH_ASSIGN_OR_RETURN(t.depth_, t.arena_.createImage({.format = kAttachmentFormats[kDepth],
                                                            .extent = extent,
                                                            .usage = kDepthUsage | VK_IMAGE_USAGE_SAMPLED_BIT,
                                                            .aspect = VK_IMAGE_ASPECT_DEPTH_BIT}));
    HEARTH_ASSIGN_OR_RETURN(t.material_depth_,
                            t.arena_.createImage({.format = kAttachmentFormats[kMaterialDepth],
                                                  .extent = extent,
                                                  .usage = kDepthUsage,
                                                  .aspect = VK_IMAGE_ASPECT_DEPTH_BIT}));
    HEARTH_ASSIGN_OR_RETURN(
        t.color_,
        t.arena_.createImage({.format = kAttachmentFormats[kColor], .extent = extent, .usage = kColorUsage}));

    const VkImageView views[kAttachmentCount] = {t.visibility_.view.get(), t.depth_.view.get(),
                                                 t.material_depth_.view.get(), t.color_.view.get()};
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = render_pass;
    info.attachmentCount = kAttachmentCount;
    info.pAttachments = views;
    info.width = extent.width;
    info.height = extent.height;
    info.layers = 1;
    VkFramebuffer framebuffer;
    HEARTH_TRY_VK(device.vk.vkCreateFramebuffer(device.handle, &info, device.allocator, &framebuffer),
                  "create a framebuffer");
    t.framebuffer_ = UniqueFramebuffer(device, framebuffer);

    HEARTH_TRY(t.createPyramid(device));
    const DescriptorPoolSizes sizes{.uniforms = 1, .storages = 1, .textures = 1, .inputs = 1};
    HEARTH_ASSIGN_OR_RETURN(t.pool_, createDescriptorPool(device, 2, sizes));
    HEARTH_ASSIGN_OR_RETURN(t.set_, allocateSet(device, t.pool_.get(), layouts.attachments.get()));
    DescriptorWriter(t.set_).input(0, t.visibility_.view.get()).write(device);
    HEARTH_ASSIGN_OR_RETURN(t.occlusion_set_, allocateSet(device, t.pool_.get(), layouts.occlusion.get()));
    DescriptorWriter(t.occlusion_set_)
        .uniform(kOcclusionViews, t.occlusion_views_)
        .storage(kOcclusionPyramid, t.pyramid_)
        .texture(kOcclusionDepth, t.depth_.view.get(), t.texel_sampler_.get())
        .write(device);
    return t;
}

Status FrameTargets::createPyramid(const Device& device)
{
    const auto [width, height] = extent();
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
    HEARTH_ASSIGN_OR_RETURN(texel_sampler_, createTexelSampler(device));
    return success();
}

} // namespace hearth::gpu
