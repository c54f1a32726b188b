// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/light_passes/mark_lights_pass.h"

#include "formats/gpu_shared/light_bits.h"
#include "formats/gpu_shared/light_volume.h"
#include "runtime/shaders/shaders.h"

#include <algorithm>

namespace hearth::gpu
{

Result<MarkLightsPass> MarkLightsPass::create(const Device& device, const DrawLayouts& layouts,
                                              const FramePasses& passes, ShadedOutput output)
{
    MarkLightsPass pass;
    const DrawPlace place = passes.place(output, FrameStep::mark_lights);
    HEARTH_ASSIGN_OR_RETURN(
        pass.volume_,
        createGraphicsPipeline(
            device, {.vertex = shaders::mark_light_vert,
                     .fragment = shaders::mark_light_frag,
                     .layout = layouts.lit_surfaces.get(),
                     .render_pass = place.render_pass,
                     .subpass = place.subpass,
                     .cull = VK_CULL_MODE_FRONT_BIT, // the eye may be in front of the back faces only
                     // the depth may be off: fragments decide
                     .depth_compare = VK_COMPARE_OP_ALWAYS,
                     .depth_write = false,
                     .colors = 2,
                     .add = true}));
    return pass;
}

void MarkLightsPass::record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                            const Scene& scene, const FrameTargets& targets) const
{
    const uint32_t lights = std::min(scene.lights->rangedCount(), shared::kMarkedLights);
    if (lights == 0)
        return;
    const uint32_t frame = scene.tables->frame;
    scene.lit_sets->setImages(device, frame, targets.litImages(LightPath::light_bits));
    const VkDescriptorSet set = scene.lit_sets->set(frame);
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layouts.lit_surfaces.get(),
                                      shared::kSetScene, 1, &set, 0, nullptr);
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, volume_.get());
    device.vk.vkCmdDraw(commands, shared::kLightVolumeVertices, lights, 0, 0);
}

} // namespace hearth::gpu
