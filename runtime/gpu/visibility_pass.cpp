// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/visibility_pass.h"

#include "runtime/gpu/frame_targets.h"
#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

Result<VisibilityPass> VisibilityPass::create(const Device& device, const DrawLayouts& layouts,
                                              VkRenderPass render_pass)
{
    VisibilityPass pass;
    HEARTH_TRY(pass.createPipelines(device, layouts, render_pass, 1, pass.opaque_[0], pass.alpha_tested_[0]));
    HEARTH_TRY(pass.createPipelines(device, layouts, render_pass, shared::kPoolSlices, pass.opaque_[1],
                                    pass.alpha_tested_[1]));
    return pass;
}

Status VisibilityPass::createPipelines(const Device& device, const DrawLayouts& layouts,
                                       VkRenderPass render_pass, uint32_t used_slices, Pipelines& opaque,
                                       Pipelines& alpha_tested)
{
    for (const Facing facing : {Facing::culled, Facing::mirrored, Facing::doubleSided})
    {
        GraphicsDescription description{
            .vertex = shaders::visibility_vert,
            .fragment = shaders::visibility_frag,
            .layout = layouts.visibility.get(),
            .render_pass = render_pass,
            .subpass = kSubpassVisibility,
            .cull =
                VkCullModeFlags(facing == Facing::doubleSided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT),
            .front_face =
                facing == Facing::mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE,
            .depth_compare = VK_COMPARE_OP_GREATER, // reversed: 1 at the near plane, 0 infinitely far away
            .depth_write = true,
            .color = true,
            .constants = {&used_slices, 1}};
        const auto index = static_cast<size_t>(facing);
        HEARTH_ASSIGN_OR_RETURN(opaque[index], createGraphicsPipeline(device, description));
        description.vertex = shaders::visibility_masked_vert;
        description.fragment = shaders::visibility_masked_frag;
        HEARTH_ASSIGN_OR_RETURN(alpha_tested[index], createGraphicsPipeline(device, description));
    }
    return success();
}

void VisibilityPass::record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                            const Scene& scene) const
{
    const VkPipelineLayout layout = layouts.visibility.get();
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1,
                                      &scene.draw_set, 0, nullptr);
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 2, 1,
                                      &scene.bins_set, 0, nullptr);
    const size_t slices = scene.used_slices == 1 ? 0 : 1;
    for (uint32_t i = 0; i < scene.bins.size(); ++i)
    {
        const SceneBin& bin = scene.bins[i];
        const Pipelines& pipelines = (bin.alpha_tested ? alpha_tested_ : opaque_)[slices];
        device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                                    pipelines[static_cast<size_t>(bin.facing)].get());
        if (bin.alpha_tested)
            device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 1, 1,
                                              &scene.materials[bin.material_row].set, 0, nullptr);
        const DrawPush push{.bin = i};
        device.vk.vkCmdPushConstants(commands, layout, kDrawPushStages, 0, sizeof(push), &push);
        device.vk.vkCmdDrawIndirect(commands, scene.buffers.bin_draws.handle.get(),
                                    i * sizeof(shared::BinDraw), 1, sizeof(shared::BinDraw));
    }
}

} // namespace hearth::gpu
