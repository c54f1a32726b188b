// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/scene_tables.h"

#include <algorithm>

namespace hearth::gpu
{

namespace
{

/// Return the buffer of a table, or nullptr if it is none of the scene's.
const Buffer* tableBuffer(const TableView& from, uint32_t table)
{
    const SceneBuffers& b = from.scene.buffers;
    const SceneTables& changing = *from.scene.tables;
    const SceneFrame& frame = from.scene.frames[from.frame];
    switch (table)
    {
    case shared::kTableFrame:
        return &from.view.frame;
    case shared::kTableInstances:
        return &changing.instances.copy(from.frame);
    case shared::kTableStates:
        return &b.states;
    case shared::kTableItems:
        return &b.items;
    case shared::kTableOrder:
        return &b.order;
    case shared::kTableClusters:
        return &b.clusters;
    case shared::kTableGroups:
        return &b.groups;
    case shared::kTableResults:
        return &b.results;
    case shared::kTableBounds:
        return &changing.bounds.copy(from.frame);
    case shared::kTableInverses:
        return &changing.inverses.copy(from.frame);
    case shared::kTableTotals:
        return &b.totals;
    case shared::kTableCounters:
        return &from.view.counters;
    case shared::kTableDraws:
        return &b.cluster_draws;
    case shared::kTableVisible:
        return &from.view.visible;
    case shared::kTableBins:
        return &b.bins;
    case shared::kTableBinDraws:
        return &from.view.bin_draws;
    case shared::kTableMaterialDraws:
        return &from.view.material_draws;
    case shared::kTableTileDraws:
        return &frame.tile_draws;
    case shared::kTableGroupItems:
        return &b.group_items;
    case shared::kTablePageRequests:
        return &frame.page_requests;
    case shared::kTableShadows:
        return &frame.shadow_block;
    case shared::kTableProxies:
        return &b.proxies;
    case shared::kTableProxyDraw:
        return &from.view.proxy_draw;
    case shared::kTableProxyChunks:
        return &from.view.proxy_chunks;
    case shared::kTableProxyPositions:
        return &b.proxy_positions;
    case shared::kTableProxyIndices:
        return &b.proxy_indices;
    case shared::kTableDeformation:
        HEARTH_ASSERT(from.scene.deformation != nullptr);
        return &from.scene.deformation->table.copy(from.frame);
    default:
        return nullptr;
    }
}

bool isUniform(uint32_t table)
{
    return table == shared::kTableFrame || table == shared::kTableShadows;
}

} // namespace

std::vector<SetBinding> tableBindings(std::span<const uint32_t> tables, VkShaderStageFlags stages)
{
    std::vector<SetBinding> bindings;
    for (const uint32_t table : tables)
        bindings.push_back(isUniform(table) ? uniformBinding(table, stages) : storageBinding(table, stages));
    return bindings;
}

Result<ComputePipeline> createTablePipeline(const Device& device, std::span<const uint32_t> spirv,
                                            std::span<const uint32_t> tables, uint32_t push_bytes,
                                            std::optional<NumberedSet> other)
{
    HEARTH_ASSIGN_OR_RETURN(UniqueSetLayout set_layout,
                            createSetLayout(device, tableBindings(tables, VK_SHADER_STAGE_COMPUTE_BIT)));
    std::vector<NumberedSet> sets{{shared::kSetTables, set_layout.get()}};
    if (other)
        sets.push_back(*other);
    HEARTH_ASSIGN_OR_RETURN(ComputePipeline pipeline, createComputePipeline(device, spirv, sets, push_bytes));
    pipeline.set_layout = std::move(set_layout);
    return pipeline;
}

void writeTables(const Device& device, const TableView& from, VkDescriptorSet set,
                 std::span<const uint32_t> tables)
{
    DescriptorWriter writer(set);
    for (const uint32_t table : tables)
    {
        const Buffer* buffer = tableBuffer(from, table);
        if (buffer == nullptr)
            HEARTH_ASSERT(table == shared::kTableStatistics || table == shared::kTablePicks);
        else if (isUniform(table))
            writer.uniform(table, *buffer);
        else
            writer.storage(table, *buffer);
    }
    writer.write(device);
}

Result<VkDescriptorSet> createTableSet(const Device& device, const TableView& from,
                                       const ComputePipeline& pipeline, std::span<const uint32_t> tables)
{
    HEARTH_ASSIGN_OR_RETURN(const VkDescriptorSet set,
                            allocateSet(device, from.scene.pool.get(), pipeline.set_layout.get()));
    writeTables(device, from, set, tables);
    return set;
}

void writePool(const Scene& scene, uint32_t frame, DescriptorWriter& writer)
{
    for (uint32_t slice = 0; slice < shared::kPoolSlices; ++slice)
        writer.storage(shared::kScenePool + slice,
                       scene.deformation != nullptr && slice == shared::kDeformationSlice
                           ? scene.deformation->table.copy(frame)
                           : scene.buffers.pool[slice]);
}

void rebindPool(const Device& device, const Scene& scene, uint32_t frame)
{
    const SceneFrame& sets = scene.frames[frame];
    const auto rebind = [&](const SceneView& view)
    {
        DescriptorWriter writer(view.draw_set);
        writePool(scene, frame, writer);
        writer.write(device);
    };
    rebind(sets.main);
    std::ranges::for_each(sets.casters, rebind);
    for (uint32_t slice = 0; slice < shared::kPoolSlices; ++slice)
        DescriptorWriter(sets.stream_copy_sets[slice])
            .storage(shared::kWordCopyTarget, scene.buffers.pool[slice])
            .write(device);
    if (scene.joined_sets != nullptr)
        scene.joined_sets->setScene(device, frame, sets.main.draw_set);
}

} // namespace hearth::gpu
