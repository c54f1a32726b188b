// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/motion_targets.h"

namespace hearth::gpu
{

Result<UniqueRenderPass> createMotionRenderPass(const Device& device)
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
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    constexpr VkPipelineStageFlags kOutput = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    constexpr VkAccessFlags kWrite = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    const VkSubpassDependency dependencies[] = {
        {VK_SUBPASS_EXTERNAL, 0, kMotionReaders, kOutput, 0, kWrite, 0},
        {0, VK_SUBPASS_EXTERNAL, kOutput, kMotionReaders, kWrite, kMotionReads, 0}};
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = &attachment;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 2;
    info.pDependencies = dependencies;
    VkRenderPass handle;
    HEARTH_TRY_VK(device.vk.vkCreateRenderPass(device.handle, &info, device.allocator, &handle),
                  "create a render pass");
    return UniqueRenderPass(device, handle);
}

Result<MotionTargets> MotionTargets::create(const Device& device, MemoryArena& arena, VkExtent2D extent)
{
    MotionTargets targets;
    HEARTH_ASSIGN_OR_RETURN(targets.image_, arena.createImage({.format = kMotionFormat,
                                                               .extent = extent,
                                                               .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                                        VK_IMAGE_USAGE_SAMPLED_BIT |
                                                                        VK_IMAGE_USAGE_TRANSFER_SRC_BIT}));
    HEARTH_ASSIGN_OR_RETURN(targets.render_pass_, createMotionRenderPass(device));
    const VkImageView view = targets.image_.view.get();
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = targets.render_pass_.get();
    info.attachmentCount = 1;
    info.pAttachments = &view;
    info.width = extent.width;
    info.height = extent.height;
    info.layers = 1;
    VkFramebuffer handle;
    HEARTH_TRY_VK(device.vk.vkCreateFramebuffer(device.handle, &info, device.allocator, &handle),
                  "create a framebuffer");
    targets.framebuffer_ = UniqueFramebuffer(device, handle);
    return targets;
}

void MotionTargets::beginFrame(const shared::FrameView& view, uint64_t step)
{
    if (step_ != 0)
        earlier_view_ = view_;
    view_ = view;
    step_ = step;
}

} // namespace hearth::gpu
