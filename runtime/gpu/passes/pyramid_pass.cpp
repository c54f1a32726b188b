// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/pyramid_pass.h"

#include "formats/gpu_shared/occlusion.h"
#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

Result<PyramidPass> PyramidPass::create(const Device& device, const DrawLayouts& layouts)
{
    PyramidPass pass;
    const NumberedSet sets[] = {{shared::kSetPyramid, layouts.occlusion.get()}};
    HEARTH_ASSIGN_OR_RETURN(pass.tiles_, createComputePipeline(device, shaders::pyramid_tiles_comp, sets,
                                                               sizeof(shared::PyramidPush)));
    HEARTH_ASSIGN_OR_RETURN(pass.top_, createComputePipeline(device, shaders::pyramid_top_comp, sets,
                                                             sizeof(shared::PyramidPush)));
    return pass;
}

void PyramidPass::record(const Device& device, VkCommandBuffer commands, const FrameTargets& targets,
                         VkDescriptorSet set) const
{
    const auto [width, height] = targets.extent();
    const shared::PyramidPush push{width, height};
    const auto dispatch = [&](const ComputePipeline& pipeline, uint32_t x, uint32_t y)
    {
        device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
        device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout.get(),
                                          shared::kSetPyramid, 1, &set, 0, nullptr);
        device.vk.vkCmdPushConstants(commands, pipeline.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), &push);
        device.vk.vkCmdDispatch(commands, x, y, 1);
        barrier(device, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT);
    };
    dispatch(tiles_, (width + shared::kPyramidTilePixels - 1) / shared::kPyramidTilePixels,
             (height + shared::kPyramidTilePixels - 1) / shared::kPyramidTilePixels);
    if (shared::pyramidLevels(width, height) > shared::kPyramidTileLevels)
        dispatch(top_, 1, 1);
}

} // namespace hearth::gpu
