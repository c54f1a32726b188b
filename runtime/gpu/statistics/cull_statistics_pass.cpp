// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/statistics/cull_statistics_pass.h"

#include "runtime/gpu/scene/scene_tables.h"
#include "runtime/shaders/shaders.h"

#include <algorithm>

namespace hearth::gpu
{

namespace
{

constexpr uint32_t kRigidStatisticsTables[] = {
    shared::kTableFrame,  shared::kTableInstances, shared::kTableStates,
    shared::kTableBounds, shared::kTableItems,     shared::kTableOrder,
    shared::kTableGroups, shared::kTableClusters,  shared::kTableStatistics};
constexpr uint32_t kDeformedStatisticsTables[] = {
    shared::kTableFrame,  shared::kTableInstances,   shared::kTableStates,
    shared::kTableBounds, shared::kTableItems,       shared::kTableOrder,
    shared::kTableGroups, shared::kTableDeformation, shared::kTableStatistics};

} // namespace

Result<CullStatisticsPass> CullStatisticsPass::create(const Device& device, const Scene& scene)
{
    CullStatisticsPass pass(device);
    HEARTH_ASSIGN_OR_RETURN(pass.statistics_, pass.arena_.createBuffer(sizeof(shared::CullStatistics),
                                                                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                                           VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                                                           VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                                       MemoryKind::device));
    HEARTH_ASSIGN_OR_RETURN(pass.pool_, createDescriptorPool(device, 2 * kMaxFramesInFlight,
                                                             {.uniforms = 2 * kMaxFramesInFlight,
                                                              .storages = 16 * kMaxFramesInFlight}));
    HEARTH_ASSIGN_OR_RETURN(pass.rigid_, pass.createPipeline(device, scene, shaders::cull_statistics_comp,
                                                             kRigidStatisticsTables));
    if (scene.deformation != nullptr)
    {
        HEARTH_ASSIGN_OR_RETURN(pass.deformed_,
                                pass.createPipeline(device, scene, shaders::cull_statistics_deformed_comp,
                                                    kDeformedStatisticsTables));
    }
    return pass;
}

Result<CullStatisticsPass::StatisticsPipeline>
CullStatisticsPass::createPipeline(const Device& device, const Scene& scene, std::span<const uint32_t> shader,
                                   std::span<const uint32_t> tables) const
{
    StatisticsPipeline counting;
    HEARTH_ASSIGN_OR_RETURN(counting.pipeline,
                            createTablePipeline(device, shader, tables, sizeof(shared::CullStatisticsPush)));
    for (uint32_t number = 0; number < scene.frames.size(); ++number)
    {
        HEARTH_ASSIGN_OR_RETURN(const VkDescriptorSet set,
                                allocateSet(device, pool_.get(), counting.pipeline.set_layout.get()));
        writeTables(device, mainView(scene, number), set, tables);
        DescriptorWriter(set).storage(shared::kTableStatistics, statistics_).write(device);
        counting.sets.push_back(set);
    }
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
    const auto count = [&](const StatisticsPipeline& counting, const shared::CullStatisticsPush& push)
    {
        const VkPipelineLayout layout = counting.pipeline.layout.get();
        device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                    counting.pipeline.pipeline.get());
        device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout,
                                          shared::kSetTables, 1, &counting.sets[scene.tables->frame], 0,
                                          nullptr);
        device.vk.vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
        const uint32_t groups =
            std::max(push.item_count,
                     (push.instance_count + shared::kWorkItemClusters - 1) / shared::kWorkItemClusters);
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
