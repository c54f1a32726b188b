// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/forward_renderer.h"

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/shaders/shaders.h"
#include "tests/runtime/shaders/test_shaders.h"

#include <cstring>

namespace hearth::test
{

namespace
{

constexpr VkFormat kDerivativeFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

template <typename T>
T take(Result<T> result)
{
    HEARTH_ASSERT(result.ok());
    return std::move(*result);
}

VkAttachmentDescription attachment(VkFormat format, VkAttachmentLoadOp load, VkImageLayout before,
                                   VkImageLayout after)
{
    VkAttachmentDescription description{};
    description.format = format;
    description.samples = VK_SAMPLE_COUNT_1_BIT;
    description.loadOp = load;
    description.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    description.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    description.initialLayout = before;
    description.finalLayout = after;
    return description;
}

/// Wait for all earlier work, and make it visible to all later work.
constexpr VkAccessFlags kAllAccess = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
constexpr VkSubpassDependency kDependencies[] = {
    {VK_SUBPASS_EXTERNAL, 0, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT,
     kAllAccess, kAllAccess, 0},
    {0, VK_SUBPASS_EXTERNAL, VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
     kAllAccess, kAllAccess, 0}};

gpu::UniqueRenderPass createPass(const gpu::Device& device,
                                 std::span<const VkAttachmentDescription> attachments,
                                 const VkSubpassDescription& subpass)
{
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 2;
    info.pDependencies = kDependencies;
    VkRenderPass pass;
    HEARTH_ASSERT(device.vk.vkCreateRenderPass(device.handle, &info, device.allocator, &pass) == VK_SUCCESS);
    return {device, pass};
}

gpu::UniqueRenderPass createForwardPass(const gpu::Device& device)
{
    const VkAttachmentDescription attachments[] = {
        attachment(gpu::kColorFormat, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_IMAGE_LAYOUT_UNDEFINED,
                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
        attachment(gpu::depthFormat(gpu::MaterialTest::depth), VK_ATTACHMENT_LOAD_OP_CLEAR,
                   VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL)};
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depth{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pDepthStencilAttachment = &depth;
    return createPass(device, attachments, subpass);
}

gpu::UniqueRenderPass createDerivativesPass(const gpu::Device& device)
{
    const VkAttachmentDescription attachments[] = {
        attachment(kDerivativeFormat, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_IMAGE_LAYOUT_UNDEFINED,
                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
        attachment(gpu::kVisibilityFormat, VK_ATTACHMENT_LOAD_OP_LOAD, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL)};
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference input{1, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.inputAttachmentCount = 1;
    subpass.pInputAttachments = &input;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    return createPass(device, attachments, subpass);
}

gpu::UniqueFramebuffer createFramebuffer(const gpu::Device& device, VkRenderPass pass, VkExtent2D extent,
                                         std::initializer_list<VkImageView> views)
{
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = pass;
    info.attachmentCount = static_cast<uint32_t>(views.size());
    info.pAttachments = views.begin();
    info.width = extent.width;
    info.height = extent.height;
    info.layers = 1;
    VkFramebuffer framebuffer;
    HEARTH_ASSERT(device.vk.vkCreateFramebuffer(device.handle, &info, device.allocator, &framebuffer) ==
                  VK_SUCCESS);
    return {device, framebuffer};
}

template <typename T>
std::vector<T> readTexels(viewer::VulkanHost& host, const gpu::Device& device, const gpu::Image& image)
{
    const std::vector<std::byte> bytes = take(host.read(device, image, sizeof(T)));
    std::vector<T> texels(bytes.size() / sizeof(T));
    std::memcpy(texels.data(), bytes.data(), bytes.size());
    return texels;
}

/// Push constants of forward.vert.
struct ForwardPush
{
    uint32_t bin;
    uint32_t material_number;
};

/// Create a layout with the sets of the visibility pass. The fragment stage includes the shading code, whose
/// block of push constants is larger; it reads the post settings alone.
gpu::UniquePipelineLayout createForwardLayout(const gpu::Device& device, const gpu::DrawLayouts& layouts)
{
    const gpu::NumberedSet sets[] = {{shared::kSetScene, layouts.scene.get()},
                                     {shared::kSetMaterial, layouts.material.get()},
                                     {shared::kSetBins, layouts.bins.get()}};
    return take(
        gpu::createPipelineLayout(device, sets, gpu::kShadingPushStages, sizeof(shared::ShadingPush)));
}

} // namespace

ForwardRenderer::ForwardRenderer(viewer::VulkanHost& host, const gpu::Device& device)
    : host_(host),
      device_(device),
      layouts_(take(gpu::DrawLayouts::create(device, {}))),
      forward_layout_(createForwardLayout(device, layouts_)),
      forward_pass_(createForwardPass(device)),
      derivatives_pass_(createDerivativesPass(device))
{
}

void ForwardRenderer::begin(VkCommandBuffer commands, VkRenderPass pass, VkFramebuffer framebuffer,
                            VkExtent2D extent) const
{
    const VkRect2D area{{0, 0}, extent};
    const VkClearValue clear[2] = {}; // depth 0: infinitely far away
    VkRenderPassBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = pass;
    info.framebuffer = framebuffer;
    info.renderArea = area;
    info.clearValueCount = 2;
    info.pClearValues = clear;
    device_.vk.vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0, 1};
    device_.vk.vkCmdSetViewport(commands, 0, 1, &viewport);
    device_.vk.vkCmdSetScissor(commands, 0, 1, &area);
}

gpu::UniquePipeline ForwardRenderer::createPipeline(const gpu::Scene& scene, uint32_t row,
                                                    gpu::Facing facing) const
{
    const gpu::ShadingVariant& variant = scene.materials[row].variant;
    gpu::DrawConstants constants{};
    constants[shared::kConstantUsedSlices] = variant.used_slices;
    constants[shared::kConstantTextures] = variant.textures;
    constants[shared::kConstantUvSets] = variant.uv_sets;
    constants[shared::kConstantLayers] = variant.layers;
    constants[shared::kConstantUnlit] = variant.unlit;
    return take(gpu::createGraphicsPipeline(
        device_, {.vertex = shaders::forward_vert,
                  .fragment = shaders::forward_frag,
                  .layout = forward_layout_.get(),
                  .render_pass = forward_pass_.get(),
                  .subpass = 0,
                  .cull = VkCullModeFlags(facing == gpu::Facing::doubleSided ? VK_CULL_MODE_NONE
                                                                             : VK_CULL_MODE_BACK_BIT),
                  .front_face = facing == gpu::Facing::mirrored ? VK_FRONT_FACE_CLOCKWISE
                                                                : VK_FRONT_FACE_COUNTER_CLOCKWISE,
                  .depth_compare = VK_COMPARE_OP_GREATER,
                  .depth_write = true,
                  .colors = 1,
                  .constants = constants}));
}

void ForwardRenderer::drawMaterial(VkCommandBuffer commands, const gpu::Scene& scene, uint32_t row,
                                   uint32_t bin, VkPipeline pipeline) const
{
    const VkPipelineLayout layout = forward_layout_.get();
    const VkDescriptorSet sets[] = {scene.frame().main.draw_set, materialSet(scene, row),
                                    scene.frame().main.bins_set};
    const shared::ShadingPush neutral{.exposure = 1};
    const ForwardPush push{bin, row + 1};
    device_.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    device_.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, shared::kSetScene,
                                       3, sets, 0, nullptr);
    device_.vk.vkCmdPushConstants(commands, layout, gpu::kShadingPushStages, 0, sizeof(neutral), &neutral);
    device_.vk.vkCmdPushConstants(commands, layout, gpu::kShadingPushStages, 0, sizeof(push), &push);
    device_.vk.vkCmdDrawIndirect(commands, scene.frame().main.bin_draws.handle.get(),
                                 bin * sizeof(shared::BinDraw), 1, sizeof(shared::BinDraw));
}

std::vector<uint32_t> ForwardRenderer::draw(const gpu::Scene& scene, VkExtent2D extent)
{
    gpu::MemoryArena arena(device_);
    const gpu::Image color = take(
        arena.createImage({.format = gpu::kColorFormat,
                           .extent = extent,
                           .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}));
    const gpu::Image depth = take(arena.createImage({.format = gpu::depthFormat(gpu::MaterialTest::depth),
                                                     .extent = extent,
                                                     .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                                     .aspect = VK_IMAGE_ASPECT_DEPTH_BIT}));
    const gpu::UniqueFramebuffer framebuffer =
        createFramebuffer(device_, forward_pass_.get(), extent, {color.view.get(), depth.view.get()});
    std::vector<gpu::UniquePipeline> pipelines;
    const Status status = host_.run(
        [&](VkCommandBuffer commands)
        {
            begin(commands, forward_pass_.get(), framebuffer.get(), extent);
            for (uint32_t bin = 0; bin < scene.bins.size(); ++bin)
                for (uint32_t row = 0; row < scene.materials.size(); ++row)
                {
                    HEARTH_ASSERT(!scene.bins[bin].alpha_tested);
                    pipelines.push_back(createPipeline(scene, row, scene.bins[bin].facing));
                    drawMaterial(commands, scene, row, bin, pipelines.back().get());
                }
            device_.vk.vkCmdEndRenderPass(commands);
            return success();
        });
    HEARTH_ASSERT(status.ok());
    return readTexels<uint32_t>(host_, device_, color);
}

std::vector<std::array<float, 4>> ForwardRenderer::uvDerivatives(const gpu::Scene& scene,
                                                                 const gpu::FrameTargets& targets)
{
    const VkExtent2D extent = targets.extent();
    gpu::MemoryArena arena(device_);
    const gpu::Image image = take(
        arena.createImage({.format = kDerivativeFormat,
                           .extent = extent,
                           .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}));
    const gpu::UniqueFramebuffer framebuffer = createFramebuffer(
        device_, derivatives_pass_.get(), extent, {image.view.get(), targets.visibility().view.get()});
    const VkPipelineLayout layout = layouts_.shading.get();
    const gpu::UniquePipeline pipeline =
        take(gpu::createGraphicsPipeline(device_, {.vertex = shaders::fullscreen_vert,
                                                   .fragment = shaders::uv_derivatives_frag,
                                                   .layout = layout,
                                                   .render_pass = derivatives_pass_.get(),
                                                   .subpass = 0,
                                                   .depth_compare = VK_COMPARE_OP_ALWAYS,
                                                   .depth_write = false,
                                                   .colors = 1}));
    const Status status = host_.run(
        [&](VkCommandBuffer commands)
        {
            begin(commands, derivatives_pass_.get(), framebuffer.get(), extent);
            const VkDescriptorSet sets[] = {scene.frame().main.draw_set, materialSet(scene, 0),
                                            targets.attachments().set};
            const shared::ShadingPush push{};
            device_.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
            device_.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout,
                                               shared::kSetScene, 3, sets, 0, nullptr);
            device_.vk.vkCmdPushConstants(commands, layout, gpu::kShadingPushStages, 0, sizeof(push), &push);
            device_.vk.vkCmdDraw(commands, 3, 1, 0, 0);
            device_.vk.vkCmdEndRenderPass(commands);
            return success();
        });
    HEARTH_ASSERT(status.ok());
    return readTexels<std::array<float, 4>>(host_, device_, image);
}

} // namespace hearth::test
