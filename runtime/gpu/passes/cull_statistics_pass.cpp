// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/cull_statistics_pass.h"

#include "runtime/shaders/shaders.h"

#include <algorithm>

namespace hearth::gpu
{

namespace
{

struct StatisticsPush
{
    uint32_t first_item;
    uint32_t item_count;
    uint32_t instance_count;
};

} // namespace

Result<CullStatisticsPass> CullStatisticsPass::create(const Device& device, const Scene& scene)
{
    CullStatisticsPass pass(device);
    HEARTH_ASSIGN_OR_RETURN(pass.statistics_, pass.arena_.createBuffer(sizeof(shared::CullStatistics),
                                                                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                                           VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                                                           VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                                       MemoryKind::device));
    HEARTH_ASSIGN_OR_RETURN(pass.pool_, createDescriptorPool(device, 2, {.uniforms = 2, .storages = 16}));
    HEARTH_ASSIGN_OR_RETURN(pass.rigid_, pass.createPipeline(device, scene, shaders::cull_statistics_comp,
                                                             scene.buffers.clusters));
    if (scene.deformation != nullptr)
    {
        HEARTH_ASSIGN_OR_RETURN(pass.deformed_,
                                pass.createPipeline(device, scene, shaders::cull_statistics_deformed_comp,
                                                    scene.deformation->buffer));
    }
    return pass;
}

Result<CullStatisticsPass::StatisticsPipeline>
CullStatisticsPass::createPipeline(const Device& device, const Scene& scene, std::span<const uint32_t> shader,
                                   const Buffer& clusters) const
{
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    StatisticsPipeline counting;
    HEARTH_ASSIGN_OR_RETURN(
        counting.pipeline, createComputePipeline(device, shader,
                                                 {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kStorage, kStorage,
                                                  kStorage, kStorage, kStorage, kStorage, kStorage, kStorage},
                                                 sizeof(StatisticsPush)));
    HEARTH_ASSIGN_OR_RETURN(counting.set,
                            allocateSet(device, pool_.get(), counting.pipeline.set_layout.get()));
    const SceneBuffers& b = scene.buffers;
    DescriptorWriter(counting.set)
        .uniform(0, b.frame)
        .storage(1, b.instances)
        .storage(2, b.states)
        .storage(3, b.bounds)
        .storage(4, b.items)
        .storage(5, b.order)
        .storage(6, clusters)
        .storage(7, b.groups)
        .storage(8, statistics_)
        .write(device);
    return counting;
}

void CullStatisticsPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene) const
{
    constexpr VkPipelineStageFlags kTransfer = VK_PIPELINE_STAGE_TRANSFER_BIT;
    constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    // waits for the copy of the last numbers, and for the culling
    barrier(device, commands, kTransfer | kCompute, VK_ACCESS_SHADER_WRITE_BIT, kTransfer | kCompute,
            VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_SHADER_READ_BIT);
    device.vk.vkCmdFillBuffer(commands, statistics_.handle.get(), 0, VK_WHOLE_SIZE, 0);
    barrier(device, commands, kTransfer, VK_ACCESS_TRANSFER_WRITE_BIT, kCompute,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
    const auto count = [&](const StatisticsPipeline& counting, const StatisticsPush& push)
    {
        const VkPipelineLayout layout = counting.pipeline.layout.get();
        device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                    counting.pipeline.pipeline.get());
        device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1,
                                          &counting.set, 0, nullptr);
        device.vk.vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
        const uint32_t groups = std::max(push.item_count, (push.instance_count + 63) / 64);
        if (groups > 0)
            device.vk.vkCmdDispatch(commands, std::min(groups, shared::kMaxDispatchX),
                                    (groups + shared::kMaxDispatchX - 1) / shared::kMaxDispatchX, 1);
    };
    const uint32_t rigid = rigidItems(scene);
    count(rigid_, {0, rigid, scene.instance_count});
    if (deformed_)
        count(*deformed_, {rigid, scene.item_count - rigid, 0});
    barrier(device, commands, kCompute, VK_ACCESS_SHADER_WRITE_BIT, kTransfer, VK_ACCESS_TRANSFER_READ_BIT);
}

} // namespace hearth::gpu
