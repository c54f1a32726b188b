// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/temporal/temporal_pass.h"

#include "runtime/gpu/vulkan/image_barrier.h"
#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

namespace
{

/// Return the digits of a number in a base, mirrored at the point: 0 to 1.
float mirrorDigits(uint32_t number, uint32_t base)
{
    float sum = 0, place = 1;
    for (; number > 0; number /= base)
    {
        place /= static_cast<float>(base);
        sum += place * static_cast<float>(number % base);
    }
    return sum;
}

} // namespace

Float2 jitterShift(uint32_t number, VkExtent2D extent)
{
    const uint32_t index = number % kJitterFrames + 1; // all digits of 0 are 0
    return {(2 * mirrorDigits(index, 2) - 1) / static_cast<float>(extent.width),
            (2 * mirrorDigits(index, 3) - 1) / static_cast<float>(extent.height)};
}

Result<TemporalPass> TemporalPass::create(const Device& device, const DrawLayouts& layouts)
{
    TemporalPass pass;
    HEARTH_ASSIGN_OR_RETURN(pass.render_pass_, createTemporalRenderPass(device));
    const NumberedSet sets[] = {{shared::kSetTemporal, layouts.temporal.get()}};
    HEARTH_ASSIGN_OR_RETURN(pass.layout_, createPipelineLayout(device, sets, VK_SHADER_STAGE_FRAGMENT_BIT,
                                                               sizeof(shared::TemporalPush)));
    HEARTH_ASSIGN_OR_RETURN(pass.pipeline_,
                            createGraphicsPipeline(device, {.vertex = shaders::post_vert,
                                                            .fragment = shaders::temporal_frag,
                                                            .layout = pass.layout_.get(),
                                                            .render_pass = pass.render_pass_.get(),
                                                            .subpass = 0,
                                                            .depth_compare = VK_COMPARE_OP_ALWAYS,
                                                            .depth_write = false,
                                                            .colors = 2}));
    return pass;
}

void TemporalPass::record(const Device& device, VkCommandBuffer commands, FrameTargets& targets,
                          bool resets) const
{
    HEARTH_ASSERT(targets.options().has_temporal_filter);
    const DeviceTable& vk = device.vk;
    constexpr VkPipelineStageFlags kFragments = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
    constexpr VkPipelineStageFlags kTransfer = VK_PIPELINE_STAGE_TRANSFER_BIT;
    TemporalTargets& temporal = targets.temporal();
    const bool has_history = temporal.beginFrame(device, commands, targets.motion()) && !resets;
    // waits for the frame
    transition(device, commands, targets.color(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
               VK_ACCESS_SHADER_READ_BIT, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | kTransfer,
               kFragments);
    const VkExtent2D extent = targets.outputExtent();
    const uint32_t number = targets.motion().number();
    VkRenderPassBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    begin.renderPass = render_pass_.get();
    begin.framebuffer = temporal.framebuffer(number);
    begin.renderArea.extent = extent;
    vk.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0, 1};
    const VkRect2D scissor{{0, 0}, extent};
    vk.vkCmdSetViewport(commands, 0, 1, &viewport);
    vk.vkCmdSetScissor(commands, 0, 1, &scissor);
    const VkDescriptorSet set = temporal.set(number);
    const shared::TemporalPush push{.has_history = has_history ? 1u : 0u};
    vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
    vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), shared::kSetTemporal,
                               1, &set, 0, nullptr);
    vk.vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(push), &push);
    vk.vkCmdDraw(commands, 3, 1, 0, 0);
    vk.vkCmdEndRenderPass(commands);
    transition(device, commands, targets.color(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 0, VK_ACCESS_TRANSFER_READ_BIT, kFragments, kTransfer);
}

} // namespace hearth::gpu
