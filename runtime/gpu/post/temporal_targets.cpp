// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/post/temporal_targets.h"

#include "runtime/gpu/vulkan/image_barrier.h"
#include "runtime/gpu/vulkan/sampler.h"

namespace hearth::gpu
{

namespace
{

constexpr VkFormat kHistoryFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kFilteredFormat = VK_FORMAT_R8G8B8A8_SRGB;

VkAttachmentDescription describeAttachment(VkFormat format, VkImageLayout layout)
{
    VkAttachmentDescription attachment{};
    attachment.format = format;
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachment.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    attachment.finalLayout = layout;
    return attachment;
}

} // namespace

Result<UniqueRenderPass> createTemporalRenderPass(const Device& device)
{
    const VkAttachmentDescription attachments[] = {
        describeAttachment(kFilteredFormat, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
        describeAttachment(kHistoryFormat, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL)};
    const VkAttachmentReference references[] = {{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
                                                {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 2;
    subpass.pColorAttachments = references;
    constexpr VkPipelineStageFlags kOutput = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    constexpr VkAccessFlags kWrite = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    const VkSubpassDependency dependencies[] = {
        {VK_SUBPASS_EXTERNAL, 0, kFilterReaders, kOutput, 0, kWrite, 0},
        {0, VK_SUBPASS_EXTERNAL, kOutput, kFilterReaders, kWrite, kFilterReads, 0}};
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 2;
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

Result<TemporalTargets> TemporalTargets::create(const Device& device, const DrawLayouts& layouts,
                                                MemoryArena& arena, const MotionTargets& motion,
                                                const Image& color)
{
    HEARTH_ASSERT(motion.hasDistances());
    constexpr VkImageUsageFlags kDrawn = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    TemporalTargets targets;
    HEARTH_ASSIGN_OR_RETURN(targets.filtered_,
                            arena.createImage({.format = kFilteredFormat,
                                               .extent = color.extent,
                                               .usage = kDrawn | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}));
    for (Image& history : targets.history_)
    {
        HEARTH_ASSIGN_OR_RETURN(history, arena.createImage({.format = kHistoryFormat,
                                                            .extent = color.extent,
                                                            .usage = kDrawn | VK_IMAGE_USAGE_SAMPLED_BIT}));
    }
    HEARTH_ASSIGN_OR_RETURN(targets.render_pass_, createTemporalRenderPass(device));
    HEARTH_TRY(targets.createFramebuffers(device));
    HEARTH_TRY(targets.createSets(device, layouts, motion, color));
    return targets;
}

Status TemporalTargets::createFramebuffers(const Device& device)
{
    for (size_t number = 0; number < 2; ++number)
    {
        const VkImageView views[] = {filtered_.view.get(), history_[number].view.get()};
        VkFramebufferCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
        info.renderPass = render_pass_.get();
        info.attachmentCount = 2;
        info.pAttachments = views;
        info.width = filtered_.extent.width;
        info.height = filtered_.extent.height;
        info.layers = 1;
        VkFramebuffer handle;
        HEARTH_TRY_VK(device.vk.vkCreateFramebuffer(device.handle, &info, device.allocator, &handle),
                      "create a framebuffer");
        framebuffers_[number] = UniqueFramebuffer(device, handle);
    }
    return success();
}

Status TemporalTargets::createSets(const Device& device, const DrawLayouts& layouts,
                                   const MotionTargets& motion, const Image& color)
{
    HEARTH_ASSIGN_OR_RETURN(texels_, createClampingSampler(device, VK_FILTER_NEAREST));
    HEARTH_ASSIGN_OR_RETURN(between_texels_, createClampingSampler(device, VK_FILTER_LINEAR));
    HEARTH_ASSIGN_OR_RETURN(pool_, createDescriptorPool(device, 2, {.textures = 10}));
    for (uint32_t number = 0; number < 2; ++number)
    {
        HEARTH_ASSIGN_OR_RETURN(sets_[number], allocateSet(device, pool_.get(), layouts.temporal.get()));
        DescriptorWriter(sets_[number])
            .texture(shared::kTemporalColor, color.view.get(), texels_.get())
            .texture(shared::kTemporalMotion, motion.image().view.get(), texels_.get())
            .texture(shared::kTemporalDistances, motion.distances(number).view.get(), texels_.get())
            .texture(shared::kTemporalEarlierDistances, motion.distances(1 - number).view.get(),
                     texels_.get())
            .texture(shared::kTemporalHistory, history_[1 - number].view.get(), between_texels_.get())
            .write(device);
    }
    return success();
}

bool TemporalTargets::beginFrame(const Device& device, VkCommandBuffer commands, const MotionTargets& motion)
{
    const bool has_history = frame_ != 0 && motion.frame() == frame_ + 1;
    const auto setLayout = [&](const Image& image)
    {
        transition(device, commands, image, VK_IMAGE_LAYOUT_UNDEFINED,
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, 0, VK_ACCESS_SHADER_READ_BIT,
                   kFilterReaders | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                   VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT);
    };
    if (!has_history)
    {
        setLayout(history_[1 - motion.number()]);
        setLayout(motion.distances(1 - motion.number()));
    }
    frame_ = motion.frame();
    return has_history;
}

} // namespace hearth::gpu
