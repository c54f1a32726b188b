// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/material_marks_pass.h"

#include "runtime/gpu/passes/shading_binder.h"
#include "runtime/gpu/passes/visibility_reading.h"

#include <algorithm>
#include <bit>

namespace hearth::gpu
{

Result<MaterialMarksPass> MaterialMarksPass::create(const Device& device, const DrawLayouts& layouts,
                                                    const FramePasses& passes, ShadedOutput output,
                                                    FrameStep step)
{
    MaterialMarksPass pass;
    pass.path_ = lightPath(output);
    pass.materials_ = passes.materials();
    const bool by_depth = pass.materials_ == MaterialTest::depth;
    const DrawPlace place = passes.place(output, step);
    const shaders::Variant reading = shaderVariant(passes.way());
    HEARTH_ASSIGN_OR_RETURN(
        pass.pipeline_,
        createGraphicsPipeline(device, {.vertex = shaders::fullscreen_vert,
                                        .fragment = (by_depth ? shaders::material_depth_frag
                                                              : shaders::material_stencil_frag)[reading],
                                        .layout = layouts.shading.get(),
                                        .one_set = passes.way() == FrameWay::one_set,
                                        .render_pass = place.render_pass,
                                        .subpass = place.subpass,
                                        .depth_compare = VK_COMPARE_OP_ALWAYS,
                                        .depth_write = by_depth,
                                        .colors = step == FrameStep::shading ? shadedColors(output) : 1,
                                        .color_write = false,
                                        .stencil = by_depth ? Stencil::none : Stencil::mark}));
    return pass;
}

void MaterialMarksPass::record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                               const Scene& scene, const FrameTargets& targets) const
{
    const ShadingBinder binder(device, commands, layouts, scene, targets, path_);
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
    binder.bindSurfaces();
    // one draw for the depth; one for each bit that the stencil needs
    const auto largest = static_cast<uint32_t>(scene.materials.size());
    const uint32_t draws = materials_ == MaterialTest::depth
                               ? 1
                               : std::min(kStencilBits, static_cast<uint32_t>(std::bit_width(largest)));
    for (uint32_t bit = 0; bit < draws; ++bit)
    {
        shared::ShadingPush push{};
        push.material = bit;
        if (materials_ == MaterialTest::id)
            device.vk.vkCmdSetStencilWriteMask(commands, VK_STENCIL_FACE_FRONT_AND_BACK, 1u << bit);
        device.vk.vkCmdPushConstants(commands, binder.layout(), kShadingPushStages, 0, sizeof(push), &push);
        device.vk.vkCmdDraw(commands, 3, 1, 0, 0);
    }
}

} // namespace hearth::gpu
