// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/shading_pass.h"

#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

Result<ShadingPass> ShadingPass::create(const Device& device, const DrawLayouts& layouts,
                                        VkRenderPass render_pass)
{
    GraphicsDescription description{.vertex = shaders::fullscreen_vert,
                                    .fragment = shaders::sky_frag,
                                    .layout = layouts.pipeline.get(),
                                    .render_pass = render_pass,
                                    .subpass = kSubpassShading,
                                    .depth_compare = VK_COMPARE_OP_EQUAL,
                                    .depth_write = false,
                                    .color = true};
    ShadingPass pass;
    HEARTH_ASSIGN_OR_RETURN(pass.sky_, createGraphicsPipeline(device, description));
    description.fragment = shaders::shading_frag;
    HEARTH_ASSIGN_OR_RETURN(pass.material_, createGraphicsPipeline(device, description));
    return pass;
}

void ShadingPass::record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                         const Scene& scene, const FrameTargets& targets, const ShadingView& view) const
{
    const VkPipelineLayout layout = layouts.pipeline.get();
    const VkDescriptorSet attachments = targets.attachments();
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1,
                                      &scene.draw_set, 0, nullptr);
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 2, 1, &attachments,
                                      0, nullptr);
    DrawPush push{.depth = 0, .shown_view = view.shown, .depth_scale = view.depth_scale};
    device.vk.vkCmdPushConstants(commands, layout, kDrawPushStages, 0, sizeof(push), &push);
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, sky_.get());
    device.vk.vkCmdDraw(commands, 3, 1, 0, 0);

    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, material_.get());
    for (uint32_t row = 0; row < scene.material_sets.size(); ++row)
    {
        const uint32_t number = row + 1; // 0 is the sky
        push.depth = static_cast<float>(number) / 65535.0f;
        device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 1, 1,
                                          &scene.material_sets[row], 0, nullptr);
        device.vk.vkCmdPushConstants(commands, layout, kDrawPushStages, 0, sizeof(push), &push);
        // no vertices where the culling pass found no cluster of this material
        device.vk.vkCmdDrawIndirect(commands, scene.buffers.material_draws.handle.get(),
                                    number * sizeof(VkDrawIndirectCommand), 1, sizeof(VkDrawIndirectCommand));
    }
}

} // namespace hearth::gpu
