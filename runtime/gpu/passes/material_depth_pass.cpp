// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/material_depth_pass.h"

#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

Result<MaterialDepthPass> MaterialDepthPass::create(const Device& device, const DrawLayouts& layouts,
                                                    VkRenderPass render_pass)
{
    MaterialDepthPass pass;
    HEARTH_ASSIGN_OR_RETURN(pass.pipeline_,
                            createGraphicsPipeline(device, {.vertex = shaders::fullscreen_vert,
                                                            .fragment = shaders::material_depth_frag,
                                                            .layout = layouts.shading.get(),
                                                            .render_pass = render_pass,
                                                            .subpass = kSubpassMaterialDepth,
                                                            .depth_compare = VK_COMPARE_OP_ALWAYS,
                                                            .depth_write = true,
                                                            .color = false}));
    return pass;
}

void MaterialDepthPass::record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                               const Scene& scene, const FrameTargets& targets) const
{
    const VkPipelineLayout layout = layouts.shading.get();
    const VkDescriptorSet attachments = targets.attachments();
    const shared::ShadingPush push{};
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, shared::kSetScene, 1,
                                      &scene.draw_set, 0, nullptr);
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout,
                                      shared::kSetAttachments, 1, &attachments, 0, nullptr);
    device.vk.vkCmdPushConstants(commands, layout, kShadingPushStages, 0, sizeof(push), &push);
    device.vk.vkCmdDraw(commands, 3, 1, 0, 0);
}

} // namespace hearth::gpu
