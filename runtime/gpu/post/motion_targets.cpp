// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/post/motion_targets.h"

namespace hearth::gpu
{

Result<UniqueRenderPass> createMotionRenderPass(const Device& device, bool has_distances)
{
    VkAttachmentDescription attachment{};
    attachment.format = kMotionFormat;
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachment.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    attachment.finalLayout = kMotionLayout;
    const VkAttachmentDescription attachments[] = {attachment, attachment};
    const VkAttachmentReference references[] = {{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
                                                {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = has_distances ? 2 : 1;
    subpass.pColorAttachments = references;
    constexpr VkPipelineStageFlags kOutput = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    constexpr VkAccessFlags kWrite = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    const VkSubpassDependency dependencies[] = {
        {VK_SUBPASS_EXTERNAL, 0, kMotionReaders, kOutput, 0, kWrite, 0},
        {0, VK_SUBPASS_EXTERNAL, kOutput, kMotionReaders, kWrite, kMotionReads, 0}};
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = subpass.colorAttachmentCount;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 2;
    info.pDependencies = dependencies;
    VkRenderPass handle;
    HEARTH_TRY_VK(device.vk.vkCreateRenderPass(device.handle, &info, device.allocator, &handle),
                  "create a render pass");
    return UniqueRenderPass(device, handle);
}

Result<MotionTargets> MotionTargets::create(const Device& device, MemoryArena& arena, VkExtent2D extent,
                                            bool has_distances)
{
    MotionTargets targets;
    const ImageDescription description{.format = kMotionFormat,
                                       .extent = extent,
                                       .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT};
    HEARTH_ASSIGN_OR_RETURN(targets.image_, arena.createImage(description));
    if (has_distances)
        for (Image& distances : targets.distances_)
        {
            HEARTH_ASSIGN_OR_RETURN(distances, arena.createImage(description));
        }
    HEARTH_ASSIGN_OR_RETURN(targets.render_pass_, createMotionRenderPass(device, has_distances));
    HEARTH_TRY(targets.createFramebuffers(device, extent));
    return targets;
}

Status MotionTargets::createFramebuffers(const Device& device, VkExtent2D extent)
{
    for (uint32_t number = 0; number < (hasDistances() ? 2u : 1u); ++number)
    {
        const VkImageView views[] = {image_.view.get(), distances_[number].view.get()};
        VkFramebufferCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
        info.renderPass = render_pass_.get();
        info.attachmentCount = hasDistances() ? 2 : 1;
        info.pAttachments = views;
        info.width = extent.width;
        info.height = extent.height;
        info.layers = 1;
        VkFramebuffer handle;
        HEARTH_TRY_VK(device.vk.vkCreateFramebuffer(device.handle, &info, device.allocator, &handle),
                      "create a framebuffer");
        framebuffers_[number] = UniqueFramebuffer(device, handle);
    }
    return success();
}

void MotionTargets::beginFrame(const shared::FrameView& view, uint64_t step)
{
    if (step_ != 0)
        earlier_view_ = view_;
    view_ = view;
    step_ = step;
    ++frame_;
}

} // namespace hearth::gpu
