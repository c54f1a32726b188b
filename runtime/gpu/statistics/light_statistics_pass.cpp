// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/statistics/light_statistics_pass.h"

#include "runtime/gpu/vulkan/image_barrier.h"
#include "runtime/shaders/shaders.h"

#include <cstring>

namespace hearth::gpu
{

namespace
{

/// Threads of a workgroup each way, as in light_statistics.comp.
constexpr uint32_t kGroupPixels = 8;

} // namespace

Result<LightStatisticsPass> LightStatisticsPass::create(const Device& device, const DrawLayouts& layouts,
                                                        const Scene& scene, const FrameTargets& targets)
{
    HEARTH_ASSERT(targets.options().keeps_visibility);
    LightStatisticsPass pass;
    const NumberedSet sets[] = {{shared::kSetScene, layouts.scene.get()},
                                {shared::kSetSceneLights, layouts.lights.get()},
                                {shared::kSetPixels, layouts.pixels.get()}};
    DrawConstants constants{};
    constants[shared::kConstantUsedSlices] = scene.used_slices;
    constants[shared::kConstantDeformed] =
        scene.deformation == nullptr ? shared::kDeformedNone : shared::kDeformedPreSkinned;
    for (size_t method = 0; method < kLightMethodCount; ++method)
    {
        constants[shared::kConstantLightList] = kLightMethods[method].light_list;
        HEARTH_ASSIGN_OR_RETURN(
            pass.pipelines_[method],
            createComputePipeline(device, shaders::light_statistics_comp, sets, 0, constants));
    }
    return pass;
}

void LightStatisticsPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                                 const FrameTargets& targets, LightMethod method) const
{
    constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    transition(device, commands, targets.visibility(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
               VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_SHADER_WRITE_BIT,
               VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT,
               VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT | kCompute | VK_PIPELINE_STAGE_TRANSFER_BIT, kCompute);
    const ComputePipeline& pipeline = pipelines_[static_cast<size_t>(method)];
    const VkDescriptorSet sets[] = {scene.frame().main.draw_set, scene.frame().light_set, targets.pixelSet()};
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout.get(),
                                      shared::kSetScene, 3, sets, 0, nullptr);
    const auto [width, height] = targets.extent();
    device.vk.vkCmdDispatch(commands, (width + kGroupPixels - 1) / kGroupPixels,
                            (height + kGroupPixels - 1) / kGroupPixels, 1);
    transition(device, commands, targets.visibility(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_ACCESS_SHADER_WRITE_BIT,
               VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_HOST_READ_BIT, kCompute,
               VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_HOST_BIT);
}

shared::LightListCounts readLightCounts(const Scene& scene)
{
    shared::LightListCounts counts;
    std::memcpy(&counts,
                scene.tables->lighting.copy(scene.tables->frame).mapped + scene.lights->layout().lists,
                sizeof(counts));
    return counts;
}

} // namespace hearth::gpu
