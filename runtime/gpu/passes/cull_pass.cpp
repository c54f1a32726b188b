// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/cull_pass.h"

#include "runtime/shaders/shaders.h"

#include <algorithm>

namespace hearth::gpu
{

namespace
{

constexpr VkDescriptorType kUniformBuffer = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
constexpr VkDescriptorType kStorageBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;

struct EmitPush
{
    uint32_t item_count;
    uint32_t slot_capacity;
};

struct CullPush
{
    uint32_t first_item;
    uint32_t item_count;
    uint32_t phase;
};

struct ScanTotalsPush
{
    uint32_t block_count;
    uint32_t slot_capacity;
    uint32_t phase;
};

struct EmitDrawsPush
{
    uint32_t bin_count;
    uint32_t item_count;
    uint32_t block_count;
    uint32_t slot_capacity;
    uint32_t phase;
};

uint32_t divideRoundUp(uint32_t count, uint32_t group_size)
{
    return (count + group_size - 1) / group_size;
}

template <typename Push>
void dispatch(const Device& device, VkCommandBuffer commands, const ComputePipeline& pipeline,
              std::initializer_list<VkDescriptorSet> sets, uint32_t groups, const Push& push)
{
    if (groups == 0)
        return;
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout.get(), 0,
                                      static_cast<uint32_t>(sets.size()), sets.begin(), 0, nullptr);
    device.vk.vkCmdPushConstants(commands, pipeline.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                 sizeof(Push), &push);
    device.vk.vkCmdDispatch(commands, std::min(groups, shared::kMaxDispatchX),
                            divideRoundUp(groups, shared::kMaxDispatchX), 1);
}

void computeBarrier(const Device& device, VkCommandBuffer commands)
{
    barrier(device, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
            VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
}

} // namespace

Result<CullPass> CullPass::create(const Device& device, const DrawLayouts& layouts)
{
    CullPass pass;
    HEARTH_ASSIGN_OR_RETURN(pass.instances_,
                            createComputePipeline(device, shaders::cull_instances_comp,
                                                  {kUniformBuffer, kStorageBuffer, kStorageBuffer,
                                                   kStorageBuffer, kStorageBuffer},
                                                  sizeof(uint32_t), layouts.occlusion.get()));
    HEARTH_ASSIGN_OR_RETURN(
        pass.clusters_,
        createComputePipeline(device, shaders::cull_clusters_comp,
                              {kUniformBuffer, kStorageBuffer, kStorageBuffer, kStorageBuffer, kStorageBuffer,
                               kStorageBuffer, kStorageBuffer, kStorageBuffer},
                              sizeof(CullPush), layouts.occlusion.get()));
    HEARTH_ASSIGN_OR_RETURN(pass.scan_blocks_,
                            createComputePipeline(device, shaders::scan_blocks_comp,
                                                  {kStorageBuffer, kStorageBuffer}, sizeof(uint32_t)));
    HEARTH_ASSIGN_OR_RETURN(pass.scan_totals_,
                            createComputePipeline(device, shaders::scan_totals_comp,
                                                  {kStorageBuffer, kStorageBuffer}, sizeof(ScanTotalsPush)));
    HEARTH_ASSIGN_OR_RETURN(
        pass.emit_visible_,
        createComputePipeline(device, shaders::emit_visible_comp,
                              {kStorageBuffer, kStorageBuffer, kStorageBuffer, kStorageBuffer, kStorageBuffer,
                               kStorageBuffer, kStorageBuffer},
                              sizeof(EmitPush)));
    HEARTH_ASSIGN_OR_RETURN(pass.emit_draws_, createComputePipeline(device, shaders::emit_draws_comp,
                                                                    {kStorageBuffer, kStorageBuffer,
                                                                     kStorageBuffer, kStorageBuffer},
                                                                    sizeof(EmitDrawsPush)));
    return pass;
}

Status CullPass::prepareDeformed(const Device& device, const DrawLayouts& layouts)
{
    if (!deformed_clusters_)
    {
        HEARTH_ASSIGN_OR_RETURN(
            deformed_clusters_,
            createComputePipeline(device, shaders::cull_clusters_deformed_comp,
                                  {kUniformBuffer, kStorageBuffer, kStorageBuffer, kStorageBuffer,
                                   kStorageBuffer, kStorageBuffer, kStorageBuffer, kStorageBuffer},
                                  sizeof(CullPush), layouts.occlusion.get()));
    }
    return success();
}

Status CullPass::createSets(const Device& device, Scene& scene) const
{
    const SceneBuffers& b = scene.buffers;
    const auto create = [&](VkDescriptorSet& set, const ComputePipeline& pipeline, const Buffer* uniform,
                            std::initializer_list<const Buffer*> storages) -> Status
    {
        HEARTH_ASSIGN_OR_RETURN(set, allocateSet(device, scene.pool.get(), pipeline.set_layout.get()));
        DescriptorWriter writer(set);
        uint32_t binding = 0;
        if (uniform != nullptr)
            writer.uniform(binding++, *uniform);
        for (const Buffer* storage : storages)
            writer.storage(binding++, *storage);
        writer.write(device);
        return success();
    };
    CullSets& sets = scene.cull_sets;
    HEARTH_TRY(
        create(sets.instances, instances_, &b.frame, {&b.instances, &b.inverses, &b.bounds, &b.states}));
    HEARTH_TRY(create(sets.clusters, clusters_, &b.frame,
                      {&b.instances, &b.states, &b.items, &b.order, &b.clusters, &b.groups, &b.results}));
    if (scene.deformation != nullptr)
        HEARTH_TRY(create(scene.deformation->cull_set, *deformed_clusters_, &b.frame,
                          {&b.instances, &b.states, &b.items, &b.order, &scene.deformation->buffer, &b.groups,
                           &b.results}));
    HEARTH_TRY(create(sets.scan_blocks, scan_blocks_, nullptr, {&b.results, &b.totals}));
    HEARTH_TRY(create(sets.scan_totals, scan_totals_, nullptr, {&b.totals, &b.counters}));
    HEARTH_TRY(
        create(sets.emit_visible, emit_visible_, nullptr,
               {&b.items, &b.order, &b.results, &b.totals, &b.cluster_draws, &b.visible, &b.material_draws}));
    HEARTH_TRY(create(sets.emit_draws, emit_draws_, nullptr, {&b.bins, &b.results, &b.totals, &b.bin_draws}));
    return success();
}

void CullPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                      const FrameTargets& targets, uint32_t phase) const
{
    const CullSets& sets = scene.cull_sets;
    const uint32_t items = scene.item_count;
    const uint32_t blocks = blockCount(scene);
    const auto bins = static_cast<uint32_t>(scene.bins.size());

    // the draws of the early phase have read the counters that the late phase adds to
    if (phase == shared::kPhaseLate)
        barrier(device, commands, VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT,
                0, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0);
    dispatch(device, commands, instances_, {sets.instances, targets.occlusionSet()},
             divideRoundUp(scene.instance_count, 64), phase);
    computeBarrier(device, commands);
    const uint32_t rigid = rigidItems(scene);
    dispatch(device, commands, clusters_, {sets.clusters, targets.occlusionSet()}, rigid,
             CullPush{0, rigid, phase});
    if (scene.deformation != nullptr)
        dispatch(device, commands, *deformed_clusters_, {scene.deformation->cull_set, targets.occlusionSet()},
                 items - rigid, CullPush{rigid, items - rigid, phase});
    computeBarrier(device, commands);
    dispatch(device, commands, scan_blocks_, {sets.scan_blocks}, blocks, items);
    computeBarrier(device, commands);
    dispatch(device, commands, scan_totals_, {sets.scan_totals}, 1,
             ScanTotalsPush{blocks, scene.slot_capacity, phase});
    computeBarrier(device, commands);
    dispatch(device, commands, emit_visible_, {sets.emit_visible}, items,
             EmitPush{items, scene.slot_capacity});
    dispatch(device, commands, emit_draws_, {sets.emit_draws}, divideRoundUp(bins, 64),
             EmitDrawsPush{bins, items, blocks, scene.slot_capacity, phase});
    barrier(device, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
            VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT);
}

} // namespace hearth::gpu
