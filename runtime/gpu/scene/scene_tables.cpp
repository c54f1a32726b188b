// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/scene_tables.h"

namespace hearth::gpu
{

namespace
{

/// Return the buffer of a table, or nullptr if it is none of the scene's.
const Buffer* tableBuffer(const Scene& scene, uint32_t table)
{
    const SceneBuffers& b = scene.buffers;
    switch (table)
    {
    case shared::kTableFrame:
        return &b.frame;
    case shared::kTableInstances:
        return &b.instances;
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
        return &b.bounds;
    case shared::kTableInverses:
        return &b.inverses;
    case shared::kTableTotals:
        return &b.totals;
    case shared::kTableCounters:
        return &b.counters;
    case shared::kTableDraws:
        return &b.cluster_draws;
    case shared::kTableVisible:
        return &b.visible;
    case shared::kTableBins:
        return &b.bins;
    case shared::kTableBinDraws:
        return &b.bin_draws;
    case shared::kTableMaterialDraws:
        return &b.material_draws;
    case shared::kTableTileDraws:
        return &b.tile_draws;
    case shared::kTableGroupItems:
        return &b.group_items;
    case shared::kTablePageRequests:
        return &b.page_requests;
    case shared::kTableDeformation:
        HEARTH_ASSERT(scene.deformation != nullptr);
        return &scene.deformation->buffer;
    default:
        return nullptr;
    }
}

} // namespace

std::vector<SetBinding> tableBindings(std::span<const uint32_t> tables, VkShaderStageFlags stages)
{
    std::vector<SetBinding> bindings;
    for (const uint32_t table : tables)
        bindings.push_back(table == shared::kTableFrame ? uniformBinding(table, stages)
                                                        : storageBinding(table, stages));
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

void writeTables(const Device& device, const Scene& scene, VkDescriptorSet set,
                 std::span<const uint32_t> tables)
{
    DescriptorWriter writer(set);
    for (const uint32_t table : tables)
    {
        const Buffer* buffer = tableBuffer(scene, table);
        if (buffer == nullptr)
            HEARTH_ASSERT(table == shared::kTableStatistics);
        else if (table == shared::kTableFrame)
            writer.uniform(table, *buffer);
        else
            writer.storage(table, *buffer);
    }
    writer.write(device);
}

Result<VkDescriptorSet> createTableSet(const Device& device, const Scene& scene,
                                       const ComputePipeline& pipeline, std::span<const uint32_t> tables)
{
    HEARTH_ASSIGN_OR_RETURN(const VkDescriptorSet set,
                            allocateSet(device, scene.pool.get(), pipeline.set_layout.get()));
    writeTables(device, scene, set, tables);
    return set;
}

} // namespace hearth::gpu
