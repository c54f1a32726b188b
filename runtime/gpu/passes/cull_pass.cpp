// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/cull_pass.h"

#include "runtime/gpu/scene/scene_tables.h"
#include "runtime/shaders/shaders.h"

#include <algorithm>

namespace hearth::gpu
{

namespace
{

constexpr uint32_t kInstanceTables[] = {shared::kTableFrame, shared::kTableInstances, shared::kTableInverses,
                                        shared::kTableBounds, shared::kTableStates};
constexpr uint32_t kClusterTables[] = {shared::kTableFrame,    shared::kTableInstances, shared::kTableStates,
                                       shared::kTableItems,    shared::kTableOrder,     shared::kTableGroups,
                                       shared::kTableClusters, shared::kTableResults};
constexpr uint32_t kDeformedClusterTables[] = {
    shared::kTableFrame, shared::kTableInstances, shared::kTableStates,      shared::kTableItems,
    shared::kTableOrder, shared::kTableGroups,    shared::kTableDeformation, shared::kTableResults};
constexpr uint32_t kListProxyTables[] = {shared::kTableInstances, shared::kTableStates, shared::kTableProxies,
                                         shared::kTableProxyDraw, shared::kTableProxyChunks};
constexpr uint32_t kScanBlockTables[] = {shared::kTableResults, shared::kTableTotals};
constexpr uint32_t kScanTotalTables[] = {shared::kTableTotals, shared::kTableCounters};
constexpr uint32_t kEmitVisibleTables[] = {
    shared::kTableItems, shared::kTableOrder,   shared::kTableResults,      shared::kTableTotals,
    shared::kTableDraws, shared::kTableVisible, shared::kTableMaterialDraws};
constexpr uint32_t kEmitDrawTables[] = {shared::kTableBins, shared::kTableResults, shared::kTableTotals,
                                        shared::kTableBinDraws};

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
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout.get(),
                                      shared::kSetTables, static_cast<uint32_t>(sets.size()), sets.begin(), 0,
                                      nullptr);
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
    const NumberedSet occlusion{shared::kSetOcclusion, layouts.occlusion.get()};
    CullPass pass;
    HEARTH_ASSIGN_OR_RETURN(pass.instances_,
                            createTablePipeline(device, shaders::cull_instances_comp, kInstanceTables,
                                                sizeof(shared::PhasePush), occlusion));
    HEARTH_ASSIGN_OR_RETURN(pass.clusters_,
                            createTablePipeline(device, shaders::cull_clusters_comp, kClusterTables,
                                                sizeof(shared::CullPush), occlusion));
    HEARTH_ASSIGN_OR_RETURN(pass.scan_blocks_,
                            createTablePipeline(device, shaders::scan_blocks_comp, kScanBlockTables,
                                                sizeof(shared::ScanBlocksPush)));
    HEARTH_ASSIGN_OR_RETURN(pass.scan_totals_,
                            createTablePipeline(device, shaders::scan_totals_comp, kScanTotalTables,
                                                sizeof(shared::ScanTotalsPush)));
    HEARTH_ASSIGN_OR_RETURN(pass.emit_visible_,
                            createTablePipeline(device, shaders::emit_visible_comp, kEmitVisibleTables,
                                                sizeof(shared::EmitVisiblePush)));
    HEARTH_ASSIGN_OR_RETURN(pass.emit_draws_,
                            createTablePipeline(device, shaders::emit_draws_comp, kEmitDrawTables,
                                                sizeof(shared::EmitDrawsPush)));
    return pass;
}

Status CullPass::prepareDeformed(const Device& device, const DrawLayouts& layouts)
{
    if (!deformed_clusters_)
    {
        HEARTH_ASSIGN_OR_RETURN(
            deformed_clusters_,
            createTablePipeline(device, shaders::cull_clusters_deformed_comp, kDeformedClusterTables,
                                sizeof(shared::CullPush),
                                NumberedSet{shared::kSetOcclusion, layouts.occlusion.get()}));
    }
    return success();
}

Status CullPass::prepareProxies(const Device& device)
{
    if (!list_proxies_)
    {
        HEARTH_ASSIGN_OR_RETURN(list_proxies_,
                                createTablePipeline(device, shaders::list_proxies_comp, kListProxyTables,
                                                    sizeof(shared::ListProxiesPush)));
    }
    return success();
}

Status CullPass::createSets(const Device& device, Scene& scene) const
{
    for (uint32_t number = 0; number < scene.frames.size(); ++number)
    {
        SceneFrame& frame = scene.frames[number];
        HEARTH_TRY(createViewSets(device, scene, number, frame.main));
        for (SceneView& view : frame.casters)
            HEARTH_TRY(createViewSets(device, scene, number, view));
    }
    return success();
}

Status CullPass::createViewSets(const Device& device, const Scene& scene, uint32_t frame,
                                SceneView& view) const
{
    const TableView from{scene, frame, view};
    CullSets& sets = view.cull_sets;
    HEARTH_ASSIGN_OR_RETURN(sets.instances, createTableSet(device, from, instances_, kInstanceTables));
    HEARTH_ASSIGN_OR_RETURN(sets.clusters, createTableSet(device, from, clusters_, kClusterTables));
    if (scene.deformation != nullptr)
    {
        HEARTH_ASSIGN_OR_RETURN(sets.deformed_clusters,
                                createTableSet(device, from, *deformed_clusters_, kDeformedClusterTables));
    }
    if (view.proxy_draw.mapped != nullptr)
    {
        HEARTH_ASSIGN_OR_RETURN(sets.list_proxies,
                                createTableSet(device, from, *list_proxies_, kListProxyTables));
    }
    HEARTH_ASSIGN_OR_RETURN(sets.scan_blocks, createTableSet(device, from, scan_blocks_, kScanBlockTables));
    HEARTH_ASSIGN_OR_RETURN(sets.scan_totals, createTableSet(device, from, scan_totals_, kScanTotalTables));
    HEARTH_ASSIGN_OR_RETURN(sets.emit_visible,
                            createTableSet(device, from, emit_visible_, kEmitVisibleTables));
    HEARTH_ASSIGN_OR_RETURN(sets.emit_draws, createTableSet(device, from, emit_draws_, kEmitDrawTables));
    return success();
}

void CullPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                      const SceneView& view, VkDescriptorSet occlusion, uint32_t phase) const
{
    const CullSets& sets = view.cull_sets;
    const uint32_t items = scene.item_count;
    const uint32_t blocks = blockCount(scene);
    const auto bins = static_cast<uint32_t>(scene.bins.size());

    dispatch(device, commands, instances_, {sets.instances, occlusion},
             divideRoundUp(scene.instance_count, shared::kGroupInstances), shared::PhasePush{phase});
    computeBarrier(device, commands);
    if (view.proxy_draw.mapped != nullptr)
    {
        dispatch(device, commands, *list_proxies_, {sets.list_proxies},
                 divideRoundUp(scene.instance_count, shared::kGroupProxies),
                 shared::ListProxiesPush{scene.instance_count});
        computeBarrier(device, commands);
    }
    const uint32_t rigid = rigidItems(scene);
    dispatch(device, commands, clusters_, {sets.clusters, occlusion}, rigid,
             shared::CullPush{0, rigid, phase});
    if (scene.deformation != nullptr)
        dispatch(device, commands, *deformed_clusters_, {sets.deformed_clusters, occlusion}, items - rigid,
                 shared::CullPush{rigid, items - rigid, phase});
    computeBarrier(device, commands);
    dispatch(device, commands, scan_blocks_, {sets.scan_blocks}, blocks, shared::ScanBlocksPush{items});
    computeBarrier(device, commands);
    dispatch(device, commands, scan_totals_, {sets.scan_totals}, 1,
             shared::ScanTotalsPush{blocks, scene.slot_capacity, phase});
    computeBarrier(device, commands);
    dispatch(device, commands, emit_visible_, {sets.emit_visible}, items,
             shared::EmitVisiblePush{items, scene.slot_capacity});
    dispatch(device, commands, emit_draws_, {sets.emit_draws}, divideRoundUp(bins, shared::kGroupBins),
             shared::EmitDrawsPush{bins, items, blocks, scene.slot_capacity, phase});
    // the next view is culled in the same work buffers; the caller copies counters and lists
    barrier(device, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
            VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT);
}

} // namespace hearth::gpu
