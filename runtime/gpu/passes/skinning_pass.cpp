// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/skinning_pass.h"

#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

namespace
{

struct PlanPush
{
    uint32_t bin_count;
    uint32_t first_bin;
    uint32_t phase;
};

} // namespace

Result<SkinningPass> SkinningPass::create(const Device& device, const DrawLayouts& layouts)
{
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    SkinningPass pass;
    HEARTH_ASSIGN_OR_RETURN(pass.plan_, createComputePipeline(device, shaders::plan_skinning_comp,
                                                              {kStorage, kStorage}, sizeof(PlanPush)));
    for (const size_t slices : {size_t{0}, size_t{1}})
    {
        const uint32_t used_slices = slices == 0 ? 1 : shared::kPoolSlices;
        HEARTH_ASSIGN_OR_RETURN(pass.skin_[slices],
                                createComputePipeline(device, shaders::skin_vertices_comp, sizeof(uint32_t),
                                                      layouts.scene.get(), {&used_slices, 1}));
    }
    return pass;
}

Status SkinningPass::createSet(const Device& device, Scene& scene) const
{
    SceneDeformation& deformation = *scene.deformation;
    HEARTH_ASSIGN_OR_RETURN(deformation.plan_set,
                            allocateSet(device, scene.pool.get(), plan_.set_layout.get()));
    DescriptorWriter(deformation.plan_set)
        .storage(0, scene.buffers.bin_draws)
        .storage(1, deformation.buffer)
        .write(device);
    return success();
}

void SkinningPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                          uint32_t phase) const
{
    const SceneDeformation& deformation = *scene.deformation;
    const auto bins = static_cast<uint32_t>(scene.bins.size());
    if (deformation.first_bin == bins)
        return;
    constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    const auto bind = [&](const ComputePipeline& pipeline, VkDescriptorSet set, const auto& push)
    {
        device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
        device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout.get(), 0,
                                          1, &set, 0, nullptr);
        device.vk.vkCmdPushConstants(commands, pipeline.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), &push);
    };
    // waits for the culling pass, which writes the lists, and for the draws of the phase before, which read
    // the old offsets
    barrier(device, commands, kCompute | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
            kCompute, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
    bind(plan_, deformation.plan_set, PlanPush{bins, deformation.first_bin, phase});
    device.vk.vkCmdDispatch(commands, 1, 1, 1);
    barrier(device, commands, kCompute, VK_ACCESS_SHADER_WRITE_BIT,
            kCompute | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT);
    bind(skin_[scene.used_slices == 1 ? 0 : 1], scene.draw_set, phase);
    device.vk.vkCmdDispatchIndirect(commands, deformation.buffer.handle.get(),
                                    offsetof(shared::DeformationHeader, groups_x));
    // page requests read other parts of the buffer
    barrier(device, commands, kCompute, VK_ACCESS_SHADER_WRITE_BIT,
            kCompute | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT |
                VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT);
}

} // namespace hearth::gpu
