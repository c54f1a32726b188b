// Writes the drawn clusters of each work item to the visible list, in the order of the work list, and marks
// the materials that are drawn. One workgroup per work item. The order depends on the masks alone, not on
// atomics, so it is deterministic.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#include "formats/gpu_shared/records.h"

layout(local_size_x = kWorkItemClusters) in;

layout(set = kSetTables, binding = kTableItems, std430) readonly buffer Items { WorkItem items[]; };
layout(set = kSetTables, binding = kTableOrder, std430) readonly buffer Order { uint order[]; };
layout(set = kSetTables, binding = kTableResults, std430) readonly buffer Results { WorkResult results[]; };
layout(set = kSetTables, binding = kTableTotals, std430) readonly buffer Totals { uint totals[]; };
layout(set = kSetTables, binding = kTableDraws, std430) readonly buffer Draws { ClusterDraw cluster_draws[]; };
layout(set = kSetTables, binding = kTableVisible, std430) writeonly buffer Visible { VisibleCluster visible[]; };
// VkDrawIndirectCommand of the full-screen triangle of each material: four words, all 0 before this pass
layout(set = kSetTables, binding = kTableMaterialDraws, std430) buffer MaterialDraws { uint material_draws[]; };
layout(push_constant) uniform Push { EmitVisiblePush push; };

void main()
{
    uint item_index = gl_WorkGroupID.y * kMaxDispatchX + gl_WorkGroupID.x;
    if (item_index >= push.item_count)
        return;
    uint lane = gl_LocalInvocationIndex;
    WorkResult result = results[item_index];
    uint word = lane < 32u ? result.mask_low : result.mask_high;
    uint bit = lane & 31u;
    if ((word >> bit & 1u) == 0u)
        return;
    uint rank = uint(bitCount(word & ((1u << bit) - 1u))) + (lane < 32u ? 0u : uint(bitCount(result.mask_low)));
    uint slot = totals[item_index / kScanBlockItems] + result.offset + rank;
    if (slot >= push.slot_capacity)
        return;
    WorkItem item = items[item_index];
    uint cluster = order[item.first + lane];
    visible[slot] = VisibleCluster(item.instance, cluster);

    uint draw = cluster_draws[cluster].material * 4u;
    atomicOr(material_draws[draw], 3u);      // vertices
    atomicOr(material_draws[draw + 1u], 1u); // instances
}
