// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/light_lists_pass.h"

#include "formats/gpu_shared/push_constants.h"
#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

namespace
{

/// Cells of a workgroup each way: kBlockCells of cell_lights.comp.
constexpr uint32_t kBlockCells = 8;

constexpr uint32_t blocksOver(uint32_t cells)
{
    return (cells + kBlockCells - 1) / kBlockCells;
}

} // namespace

Result<LightListsPass> LightListsPass::create(const Device& device, const DrawLayouts& layouts)
{
    LightListsPass pass;
    const NumberedSet sets[] = {{shared::kSetLights, layouts.lights.get()}};
    HEARTH_ASSIGN_OR_RETURN(pass.list_lights_,
                            createComputePipeline(device, shaders::list_lights_comp, sets));
    HEARTH_ASSIGN_OR_RETURN(pass.cell_lights_, createComputePipeline(device, shaders::cell_lights_comp, sets,
                                                                     sizeof(shared::LightCellsPush)));
    HEARTH_ASSIGN_OR_RETURN(pass.place_lists_,
                            createComputePipeline(device, shaders::place_lists_comp, sets));
    return pass;
}

void LightListsPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene) const
{
    constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    const shared::LightGrid& grid = scene.lights->grid();
    const auto bind = [&](const ComputePipeline& pipeline)
    {
        device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
        device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout.get(),
                                          shared::kSetLights, 1, &scene.frame().light_set, 0, nullptr);
    };
    const auto wait = [&]
    {
        barrier(device, commands, kCompute, VK_ACCESS_SHADER_WRITE_BIT, kCompute,
                VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
    };
    const auto findLights = [&](uint32_t writes)
    {
        bind(cell_lights_);
        const shared::LightCellsPush push{writes};
        device.vk.vkCmdPushConstants(commands, cell_lights_.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), &push);
        device.vk.vkCmdDispatch(commands, blocksOver(grid.max_columns), blocksOver(grid.max_rows),
                                grid.slab_count);
    };
    bind(list_lights_);
    device.vk.vkCmdDispatch(commands, 1, 1, 1);
    wait();
    findLights(0);
    wait();
    bind(place_lists_);
    device.vk.vkCmdDispatch(commands, 1, 1, 1);
    wait();
    findLights(1);
}

} // namespace hearth::gpu
