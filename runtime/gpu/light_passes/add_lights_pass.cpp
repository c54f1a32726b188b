// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/light_passes/add_lights_pass.h"

#include "formats/gpu_shared/light_volume.h"
#include "runtime/gpu/passes/visibility_reading.h"
#include "runtime/gpu/scene/scene_shadows.h"

namespace hearth::gpu
{

AddLightsPass::Variant AddLightsPass::makeVariant(const Scene& scene, LightMethod method, bool reflects)
{
    return {.shadowed = scene.shadows != nullptr,
            .filters_shadows = scene.shadows != nullptr && scene.shadows->filters(),
            .reflects = reflects,
            .light_list = lightMethodFacts(method).light_list};
}

struct AddLightsPass::Shaders
{
    const shaders::VariedShader& lists;
    const shaders::VariedShader& volume;
};

AddLightsPass::Shaders AddLightsPass::chooseShaders(bool shadowed) const
{
    using namespace shaders;
    switch (path_)
    {
    case LightPath::light_sums:
        return shadowed ? Shaders{sum_lights_shadowed_frag, sum_light_volume_shadowed_frag}
                        : Shaders{sum_lights_frag, sum_light_volume_frag};
    case LightPath::joint_sums:
        return shadowed ? Shaders{join_lights_shadowed_frag, join_light_volume_shadowed_frag}
                        : Shaders{join_lights_frag, join_light_volume_frag};
    case LightPath::encoded_joint_sums:
        return shadowed ? Shaders{join_encoded_lights_shadowed_frag, join_encoded_light_volume_shadowed_frag}
                        : Shaders{join_encoded_lights_frag, join_encoded_light_volume_frag};
    default:
        return shadowed ? Shaders{add_lights_shadowed_frag, add_light_volume_shadowed_frag}
                        : Shaders{add_lights_frag, add_light_volume_frag};
    }
}

GraphicsDescription AddLightsPass::describe(std::span<const uint32_t> vertex,
                                            std::span<const uint32_t> fragment, VkPipelineLayout layout) const
{
    return {.vertex = vertex,
            .fragment = fragment,
            .layout = layout,
            .render_pass = place_.render_pass,
            .subpass = place_.subpass,
            .depth_compare = VK_COMPARE_OP_ALWAYS,
            .depth_write = false,
            .colors = path_ == LightPath::light_sums ? 3u : 1u};
}

Result<AddLightsPass> AddLightsPass::create(const Device& device, const DrawLayouts& layouts,
                                            const FramePasses& passes, ShadedOutput output)
{
    AddLightsPass pass;
    pass.path_ = lightPath(output);
    pass.place_ = passes.place(output, FrameStep::add_lights);
    pass.way_ = passes.way();
    const VkPipelineLayout layout = layouts.lit_surfaces.get();
    GraphicsDescription zero = pass.describe(shaders::post_vert, {}, layout);
    zero.color_write = false;
    zero.stencil = Stencil::zero;
    HEARTH_ASSIGN_OR_RETURN(pass.zero_, createGraphicsPipeline(device, zero));
    GraphicsDescription enclose = pass.describe(shaders::light_volume_vert, {}, layout);
    enclose.color_write = false;
    enclose.depth_compare = VK_COMPARE_OP_GREATER; // nearer depths are greater
    enclose.stencil = Stencil::enclose;
    HEARTH_ASSIGN_OR_RETURN(pass.enclose_, createGraphicsPipeline(device, enclose));
    return pass;
}

Status AddLightsPass::prepare(const Device& device, const DrawLayouts& layouts, LightMethod method,
                              const Scene& scene)
{
    const shaders::Variant reading = shaderVariant(way_);
    for (const bool reflects : {false, true})
    {
        if (reflects && scene.bricks == nullptr)
            continue;
        const Variant variant = makeVariant(scene, method, reflects);
        if (pipelines_.contains(variant))
            continue;
        Pipelines pipelines; // an entry is whole: what fails half way is made again
        DrawConstants constants{};
        constants[shared::kConstantLightList] = variant.light_list;
        constants[shared::kConstantFiltersShadows] = variant.filters_shadows ? 1 : 0;
        constants[shared::kConstantReflects] = reflects ? 1 : 0;
        constants[shared::kConstantStored] = shared::kStoredHalf;
        const Shaders fragments = chooseShaders(variant.shadowed);
        GraphicsDescription lists =
            describe(shaders::post_vert, fragments.lists[reading], layouts.lit_surfaces.get());
        lists.add = true;
        lists.constants = constants;
        HEARTH_ASSIGN_OR_RETURN(pipelines.lists, createGraphicsPipeline(device, lists));
        if (variant.light_list == shared::kLightListVolumes)
        {
            GraphicsDescription volume = lists;
            volume.vertex = shaders::light_volume_vert;
            volume.fragment = fragments.volume[reading];
            volume.cull = VK_CULL_MODE_FRONT_BIT; // the eye may be in front of the back faces only
            volume.stencil = Stencil::take;
            HEARTH_ASSIGN_OR_RETURN(pipelines.volume, createGraphicsPipeline(device, volume));
        }
        pipelines_.emplace(variant, std::move(pipelines));
    }
    return success();
}

void AddLightsPass::record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                           const Scene& scene, const FrameTargets& targets, const ShadingSettings& view) const
{
    const auto found = pipelines_.find(makeVariant(scene, view.light_method, usesGi(scene, view)));
    HEARTH_ASSERT(found != pipelines_.end() && scene.lit_sets != nullptr);
    const uint32_t frame = scene.tables->frame;
    scene.lit_sets->setImages(device, frame, targets.litImages(path_));
    const VkDescriptorSet set = scene.lit_sets->set(frame);
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layouts.lit_surfaces.get(),
                                      shared::kSetScene, 1, &set, 0, nullptr);
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, found->second.lists.get());
    device.vk.vkCmdDraw(commands, 3, 1, 0, 0);
    if (lightMethodFacts(view.light_method).light_list == shared::kLightListVolumes)
        recordVolumes(device, commands, scene, found->second.volume.get());
}

/// Mark the pixels in the volume of a light, light them, and take the marks away: for one after another.
void AddLightsPass::recordVolumes(const Device& device, VkCommandBuffer commands, const Scene& scene,
                                  VkPipeline light) const
{
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, zero_.get());
    device.vk.vkCmdDraw(commands, 3, 1, 0, 0);
    const uint32_t count = scene.lights->rangedCount();
    for (uint32_t place = 0; place < count; ++place)
        for (const VkPipeline pipeline : {enclose_.get(), light})
        {
            device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
            device.vk.vkCmdDraw(commands, shared::kLightVolumeVertices, 1, 0, place);
        }
}

} // namespace hearth::gpu
