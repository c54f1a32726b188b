// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/shadow_pass.h"

namespace hearth::gpu
{

namespace
{

constexpr VkPipelineStageFlags kDepthStages =
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkPipelineStageFlags kReadingStages =
    VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;

// The last frame may still sample the layer, or may have drawn to it without sampling it; a copy may have
// filled it.
constexpr VkSubpassDependency kDependencies[] = {
    {VK_SUBPASS_EXTERNAL, 0, kReadingStages | kDepthStages, kDepthStages,
     VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT,
     VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, 0},
    {0, VK_SUBPASS_EXTERNAL, kDepthStages, kReadingStages, VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
     VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT, 0},
};

/// Create the render pass for one load operation; both are compatible with each other.
Result<UniqueRenderPass> createRenderPass(const Device& device, VkFormat format, VkAttachmentLoadOp load,
                                          VkImageLayout initial_layout)
{
    VkAttachmentDescription depth{};
    depth.format = format;
    depth.samples = VK_SAMPLE_COUNT_1_BIT;
    depth.loadOp = load;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    depth.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    depth.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.initialLayout = initial_layout;
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

/// Barrier for `count` layers from `first` on.
VkImageMemoryBarrier layerBarrier(const Image& image, uint32_t first, uint32_t count, VkImageLayout before,
                                  VkImageLayout after, VkAccessFlags access)
{
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.oldLayout = before;
    barrier.newLayout = after;
    barrier.dstAccessMask = access;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.handle.get();
    barrier.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, first, count};
    return barrier;
}

/// Make all layers sampleable: the descriptor set has the view of all layers from the first frame on,
/// whatever has been drawn.
void makeSampleable(const Device& device, VkCommandBuffer commands, const Image& image)
{
    const VkImageMemoryBarrier barrier =
        layerBarrier(image, 0, VK_REMAINING_ARRAY_LAYERS, VK_IMAGE_LAYOUT_UNDEFINED,
                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_SHADER_READ_BIT);
    device.vk.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                                   VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 0, nullptr, 0, nullptr, 1,
                                   &barrier);
}

/// Copy a layer. Leaves the target in TRANSFER_DST_OPTIMAL, and the source in its old layout.
void recordCopy(const Device& device, VkCommandBuffer commands, const Image& image, uint32_t from,
                uint32_t to, VkExtent2D area)
{
    constexpr VkImageLayout kSampled = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    constexpr VkImageLayout kSource = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    constexpr VkImageLayout kTarget = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    const VkImageMemoryBarrier before[] = {
        layerBarrier(image, from, 1, kSampled, kSource, VK_ACCESS_TRANSFER_READ_BIT),
        layerBarrier(image, to, 1, VK_IMAGE_LAYOUT_UNDEFINED, kTarget, VK_ACCESS_TRANSFER_WRITE_BIT)};
    device.vk.vkCmdPipelineBarrier(commands, kReadingStages, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0,
                                   nullptr, 2, before);
    const VkImageCopy region{{VK_IMAGE_ASPECT_DEPTH_BIT, 0, from, 1},
                             {0, 0, 0},
                             {VK_IMAGE_ASPECT_DEPTH_BIT, 0, to, 1},
                             {0, 0, 0},
                             {area.width, area.height, 1}};
    device.vk.vkCmdCopyImage(commands, image.handle.get(), kSource, image.handle.get(), kTarget, 1, &region);
    const VkImageMemoryBarrier after =
        layerBarrier(image, from, 1, kSource, kSampled, VK_ACCESS_SHADER_READ_BIT);
    device.vk.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, kReadingStages, 0, 0, nullptr, 0,
                                   nullptr, 1, &after);
}

} // namespace

Result<ShadowPass> ShadowPass::create(const Device& device, const DrawLayouts& layouts, ShadowDepth depth)
{
    ShadowPass pass;
    const VkFormat format = shadowFormat(depth);
    HEARTH_ASSIGN_OR_RETURN(pass.clear_pass_, createRenderPass(device, format, VK_ATTACHMENT_LOAD_OP_CLEAR,
                                                               VK_IMAGE_LAYOUT_UNDEFINED));
    HEARTH_ASSIGN_OR_RETURN(pass.load_pass_, createRenderPass(device, format, VK_ATTACHMENT_LOAD_OP_LOAD,
                                                              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL));
    HEARTH_ASSIGN_OR_RETURN(pass.casters_, BinPass::createCasters(device, layouts, pass.clear_pass_.get()));
    return pass;
}

Status ShadowPass::createMaps(const Device& device, const formats::PackView& pack,
                              const ShadowOptions& options, const ShadowDepthChoice& depth,
                              VkCommandBuffer commands, Scene& scene) const
{
    HEARTH_ASSIGN_OR_RETURN(
        scene.shadows, SceneShadows::create(device, clear_pass_.get(), pack, scene.bounds, options, depth));
    const SceneShadows& shadows = *scene.shadows;
    if (scene.deformation != nullptr)
    {
        const DeformationLayout& deformed = scene.deformation->layout;
        const std::vector<PoseRows> poses = makeRestPoses(pack, deformed);
        for (size_t i = 0; i < poses.size(); ++i)
            scene.shadows->pose(deformed.instances[i], poses[i]);
    }
    makeSampleable(device, commands, shadows.image());
    const auto write = [&](const SceneFrame& frame, const SceneView& view)
    {
        DescriptorWriter(view.draw_set)
            .uniform(shared::kSceneShadows, frame.shadow_block)
            .texture(shared::kSceneShadowMaps, shadows.image().view.get(), shadows.sampler())
            .write(device);
    };
    for (const SceneFrame& frame : scene.frames)
    {
        write(frame, frame.main);
        for (const SceneView& view : frame.casters)
            write(frame, view);
    }
    return success();
}

void ShadowPass::recordMap(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                           const Scene& scene, const SceneView& view,
                           const ShadowCache::LayerUpdate& map) const
{
    const SceneShadows& shadows = *scene.shadows;
    const shared::ShadowMap& target = shadows.plan().block.maps[map.map];
    // an earlier frame may have counted the same layer
    barrier(device, commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
            VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT);
    const VkBufferCopy counters{0, map.layer * VkDeviceSize{sizeof(shared::FrameCounters)},
                                sizeof(shared::FrameCounters)};
    device.vk.vkCmdCopyBuffer(commands, view.counters.handle.get(), shadows.casters().handle.get(), 1,
                              &counters);

    const auto side = static_cast<uint32_t>(target.size);
    const VkRect2D area{{0, 0}, {side, side}};
    if (map.copy_from)
        recordCopy(device, commands, shadows.image(), *map.copy_from, map.layer, area.extent);
    const VkClearValue nothing{.depthStencil = {0, 0}}; // at infinity
    VkRenderPassBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    begin.renderPass = (map.copy_from ? load_pass_ : clear_pass_).get();
    begin.framebuffer = shadows.framebuffer(map.layer);
    begin.renderArea = area;
    begin.clearValueCount = 1;
    begin.pClearValues = &nothing;
    device.vk.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport{0, 0, target.size, target.size, 0, 1};
    device.vk.vkCmdSetViewport(commands, 0, 1, &viewport);
    device.vk.vkCmdSetScissor(commands, 0, 1, &area);
    shared::BinPush push{};
    push.light_row = shadows.plan().row_of[map.map];
    push.map_index = map.map;
    casters_.record(device, commands, layouts, scene, view, shared::kPhaseWhole, push);
    device.vk.vkCmdEndRenderPass(commands);
}

} // namespace hearth::gpu
