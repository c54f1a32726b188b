// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/shadow_pass.h"

namespace hearth::gpu
{

namespace
{

constexpr VkPipelineStageFlags kDepthStages =
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkPipelineStageFlags kReadingStages =
    VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;

// A frame may follow another that still looks the layer up, or drew to it and looked at nothing.
constexpr VkSubpassDependency kDependencies[] = {
    {VK_SUBPASS_EXTERNAL, 0, kReadingStages | kDepthStages, kDepthStages,
     VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
     VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, 0},
    {0, VK_SUBPASS_EXTERNAL, kDepthStages, kReadingStages, VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
     VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT, 0},
};

Result<UniqueRenderPass> createRenderPass(const Device& device)
{
    VkAttachmentDescription depth{};
    depth.format = kShadowFormat;
    depth.samples = VK_SAMPLE_COUNT_1_BIT;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    depth.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    depth.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    depth.finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pDepthStencilAttachment = &reference;
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = &depth;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<uint32_t>(std::size(kDependencies));
    info.pDependencies = kDependencies;
    VkRenderPass pass;
    HEARTH_TRY_VK(device.vk.vkCreateRenderPass(device.handle, &info, device.allocator, &pass),
                  "create a render pass");
    return UniqueRenderPass(device, pass);
}

/// The view of all layers is in the descriptor set from the first frame on, whatever has been drawn.
void makeSampleable(const Device& device, VkCommandBuffer commands, const Image& image)
{
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    barrier.newLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.handle.get();
    barrier.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS};
    device.vk.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                                   VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 0, nullptr, 0, nullptr, 1,
                                   &barrier);
}

} // namespace

Result<ShadowPass> ShadowPass::create(const Device& device, const DrawLayouts& layouts)
{
    ShadowPass pass;
    HEARTH_ASSIGN_OR_RETURN(pass.render_pass_, createRenderPass(device));
    HEARTH_ASSIGN_OR_RETURN(pass.casters_, BinPass::createCasters(device, layouts, pass.render_pass_.get()));
    return pass;
}

Status ShadowPass::createMaps(const Device& device, const formats::PackView& pack,
                              const ShadowOptions& options, VkCommandBuffer commands, Scene& scene) const
{
    HEARTH_ASSIGN_OR_RETURN(scene.shadows,
                            SceneShadows::create(device, render_pass_.get(), pack, scene.bounds, options));
    const SceneShadows& shadows = *scene.shadows;
    makeSampleable(device, commands, shadows.image());
    DescriptorWriter(scene.draw_set)
        .uniform(kSceneShadows, shadows.block())
        .texture(kSceneShadowMaps, shadows.image().view.get(), shadows.sampler())
        .write(device);
    return success();
}

void ShadowPass::recordBlock(const Device& device, VkCommandBuffer commands, const Scene& scene) const
{
    const shared::ShadowBlock& block = scene.shadows->plan().block;
    constexpr VkPipelineStageFlags kDrawing =
        VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
    barrier(device, commands, kDrawing, 0, VK_PIPELINE_STAGE_TRANSFER_BIT, 0);
    device.vk.vkCmdUpdateBuffer(commands, scene.shadows->block().handle.get(), 0, sizeof(block), &block);
    barrier(device, commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, kDrawing,
            VK_ACCESS_UNIFORM_READ_BIT);
}

void ShadowPass::recordMap(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                           const Scene& scene, uint32_t map) const
{
    const SceneShadows& shadows = *scene.shadows;
    const shared::ShadowMap& target = shadows.plan().block.maps[map];
    const VkBufferCopy counters{0, target.layer * VkDeviceSize{sizeof(shared::FrameCounters)},
                                sizeof(shared::FrameCounters)};
    device.vk.vkCmdCopyBuffer(commands, scene.buffers.counters.handle.get(), shadows.casters().handle.get(),
                              1, &counters);

    const auto side = static_cast<uint32_t>(target.size);
    const VkRect2D area{{0, 0}, {side, side}};
    const VkClearValue nothing{.depthStencil = {0, 0}}; // infinitely far away
    VkRenderPassBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    begin.renderPass = render_pass_.get();
    begin.framebuffer = shadows.framebuffer(target.layer);
    begin.renderArea = area;
    begin.clearValueCount = 1;
    begin.pClearValues = &nothing;
    device.vk.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport{0, 0, target.size, target.size, 0, 1};
    device.vk.vkCmdSetViewport(commands, 0, 1, &viewport);
    device.vk.vkCmdSetScissor(commands, 0, 1, &area);
    DrawPush push;
    push.light_row = shadows.plan().row_of[map];
    push.map_index = map;
    casters_.record(device, commands, layouts, scene, shared::kPhaseWhole, push);
    device.vk.vkCmdEndRenderPass(commands);
}

} // namespace hearth::gpu
