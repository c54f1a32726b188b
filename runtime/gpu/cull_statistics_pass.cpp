// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/cull_statistics_pass.h"

#include "runtime/shaders/shaders.h"

#include <algorithm>

namespace hearth::gpu
{

Result<CullStatisticsPass> CullStatisticsPass::create(const Device& device, const Scene& scene)
{
    constexpr VkDescriptorType kUniform = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    CullStatisticsPass pass(device);
    HEARTH_ASSIGN_OR_RETURN(pass.statistics_, pass.arena_.createBuffer(sizeof(shared::CullStatistics),
                                                                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                                           VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                                                           VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                                       MemoryKind::device));
    HEARTH_ASSIGN_OR_RETURN(pass.pipeline_,
                            createComputePipeline(device, shaders::cull_statistics_comp,
                                                  {kUniform, kStorage, kStorage, kStorage, kStorage, kStorage,
                                                   kStorage, kStorage, kStorage},
                                                  sizeof(uint32_t)));
    HEARTH_ASSIGN_OR_RETURN(pass.pool_, createDescriptorPool(device, 1, {.uniforms = 1, .storages = 8}));
    HEARTH_ASSIGN_OR_RETURN(pass.set_,
                            allocateSet(device, pass.pool_.get(), pass.pipeline_.set_layout.get()));
    const SceneBuffers& b = scene.buffers;
    DescriptorWriter(pass.set_)
        .uniform(0, b.frame)
        .storage(1, b.instances)
        .storage(2, b.states)
        .storage(3, b.bounds)
        .storage(4, b.items)
        .storage(5, b.order)
        .storage(6, b.clusters)
        .storage(7, b.groups)
        .storage(8, pass.statistics_)
        .write(device);
    return pass;
}

void CullStatisticsPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene) const
{
    constexpr VkPipelineStageFlags kTransfer = VK_PIPELINE_STAGE_TRANSFER_BIT;
    constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    // behind a copy of the numbers before, and behind the culling
    barrier(device, commands, kTransfer | kCompute, VK_ACCESS_SHADER_WRITE_BIT, kTransfer | kCompute,
            VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_SHADER_READ_BIT);
    device.vk.vkCmdFillBuffer(commands, statistics_.handle.get(), 0, VK_WHOLE_SIZE, 0);
    barrier(device, commands, kTransfer, VK_ACCESS_TRANSFER_WRITE_BIT, kCompute,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.pipeline.get());
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.layout.get(), 0, 1,
                                      &set_, 0, nullptr);
    device.vk.vkCmdPushConstants(commands, pipeline_.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                 sizeof(scene.item_count), &scene.item_count);
    const uint32_t groups = std::max(scene.item_count, (scene.instance_count + 63) / 64);
    if (groups > 0)
        device.vk.vkCmdDispatch(commands, std::min(groups, shared::kDispatchRow),
                                (groups + shared::kDispatchRow - 1) / shared::kDispatchRow, 1);
    barrier(device, commands, kCompute, VK_ACCESS_SHADER_WRITE_BIT, kTransfer, VK_ACCESS_TRANSFER_READ_BIT);
}

} // namespace hearth::gpu
