// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/shading_pass.h"

#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

namespace
{

GraphicsDescription describe(std::span<const uint32_t> fragment, VkPipelineLayout layout,
                             VkRenderPass render_pass)
{
    return {.vertex = shaders::shaded_area_vert,
            .fragment = fragment,
            .layout = layout,
            .render_pass = render_pass,
            .subpass = kSubpassShading,
            .depth_compare = VK_COMPARE_OP_EQUAL,
            .depth_write = false,
            .color = true};
}

} // namespace

Result<ShadingPass> ShadingPass::create(const Device& device, const DrawLayouts& layouts,
                                        VkRenderPass render_pass)
{
    ShadingPass pass;
    pass.render_pass_ = render_pass;
    HEARTH_ASSIGN_OR_RETURN(
        pass.sky_,
        createGraphicsPipeline(device, describe(shaders::sky_frag, layouts.picture.get(), render_pass)));
    return pass;
}

Result<ShadingPipelines> ShadingPass::prepare(const Device& device, const DrawLayouts& layouts,
                                              const ShadingVariant& variant)
{
    const auto [entry, fresh] = variants_.try_emplace(variant);
    Variant& pipelines = entry->second;
    if (fresh)
    {
        const uint32_t constants[] = {variant.used_slices, variant.textures, variant.uv_sets, variant.unlit};
        GraphicsDescription description =
            describe(shaders::shading_frag, layouts.picture.get(), render_pass_);
        description.constants = constants;
        HEARTH_ASSIGN_OR_RETURN(pipelines.final_view, createGraphicsPipeline(device, description));
        description.fragment = shaders::inspect_frag;
        HEARTH_ASSIGN_OR_RETURN(pipelines.inspection, createGraphicsPipeline(device, description));
    }
    return ShadingPipelines{pipelines.final_view.get(), pipelines.inspection.get()};
}

void ShadingPass::record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                         const Scene& scene, const FrameTargets& targets, const ShadingView& view) const
{
    const VkPipelineLayout layout = layouts.picture.get();
    const VkDescriptorSet attachments = targets.attachments();
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1,
                                      &scene.draw_set, 0, nullptr);
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 2, 1, &attachments,
                                      0, nullptr);
    DrawPush push{.depth = 0, .shown_view = view.shown, .depth_scale = view.depth_scale};
    device.vk.vkCmdPushConstants(commands, layout, kDrawPushStages, 0, sizeof(push), &push);
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, sky_.get());
    const bool tiles = shadesTiles(scene, view.area);
    const VkBuffer draws = (tiles ? scene.buffers.tile_draws : scene.buffers.material_draws).handle.get();
    const auto draw = [&](uint32_t number)
    {
        device.vk.vkCmdDrawIndirect(commands, draws, number * sizeof(VkDrawIndirectCommand), 1,
                                    sizeof(VkDrawIndirectCommand));
    };
    if (tiles)
        draw(0);
    else
        device.vk.vkCmdDraw(commands, 3, 1, 0, 0);

    for (uint32_t row = 0; row < scene.materials.size(); ++row)
    {
        const SceneMaterial& material = scene.materials[row];
        device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                                    view.shown == shared::kViewFinal ? material.pipelines.final_view
                                                                     : material.pipelines.inspection);
        const uint32_t number = row + 1; // 0 is the sky
        push.depth = static_cast<float>(number) / 65535.0f;
        device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 1, 1,
                                          &material.set, 0, nullptr);
        device.vk.vkCmdPushConstants(commands, layout, kDrawPushStages, 0, sizeof(push), &push);
        draw(number); // of nothing where the material is not seen
    }
}

} // namespace hearth::gpu
