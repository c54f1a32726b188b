// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/skinning_pass.h"

#include "runtime/gpu/scene/scene_tables.h"
#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

namespace
{

constexpr uint32_t kPlanTables[] = {shared::kTableBinDraws, shared::kTableDeformation};

// both passes bind one set with the same number
static_assert(shared::kSetTables == shared::kSetScene);

} // namespace

Result<SkinningPass> SkinningPass::create(const Device& device, const DrawLayouts& layouts)
{
    SkinningPass pass;
    HEARTH_ASSIGN_OR_RETURN(pass.plan_, createTablePipeline(device, shaders::plan_skinning_comp, kPlanTables,
                                                            sizeof(shared::SkinningPlanPush)));
    const NumberedSet sets[] = {{shared::kSetScene, layouts.scene.get()}};
    for (const size_t slices : {size_t{0}, size_t{1}})
    {
        DrawConstants constants{};
        constants[shared::kConstantUsedSlices] = slices == 0 ? 1 : shared::kPoolSlices;
        HEARTH_ASSIGN_OR_RETURN(pass.skin_[slices],
                                createComputePipeline(device, shaders::skin_vertices_comp, sets,
                                                      sizeof(shared::PhasePush), constants));
    }
    return pass;
}

Status SkinningPass::createSets(const Device& device, Scene& scene) const
{
    for (uint32_t number = 0; number < scene.frames.size(); ++number)
    {
        HEARTH_ASSIGN_OR_RETURN(scene.frames[number].skinning_set,
                                createTableSet(device, mainView(scene, number), plan_, kPlanTables));
    }
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
        device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout.get(),
                                          shared::kSetScene, 1, &set, 0, nullptr);
        device.vk.vkCmdPushConstants(commands, pipeline.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), &push);
    };
    // waits for the culling pass, which writes the lists, and for the draws of this frame so far, which read
    // the old offsets: those of the phase before, and of shadow casters
    barrier(device, commands, kCompute | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
            kCompute, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
    bind(plan_, scene.frame().skinning_set, shared::SkinningPlanPush{bins, deformation.first_bin, phase});
    device.vk.vkCmdDispatch(commands, 1, 1, 1);
    barrier(device, commands, kCompute, VK_ACCESS_SHADER_WRITE_BIT,
            kCompute | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT);
    bind(skin_[scene.used_slices == 1 ? 0 : 1], scene.frame().main.draw_set, shared::PhasePush{phase});
    device.vk.vkCmdDispatchIndirect(commands, deformation.table.copy(scene.tables->frame).handle.get(),
                                    offsetof(shared::DeformationHeader, groups_x));
    // page requests read other parts of the buffer
    barrier(device, commands, kCompute, VK_ACCESS_SHADER_WRITE_BIT, kCompute | VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT);
}

} // namespace hearth::gpu
