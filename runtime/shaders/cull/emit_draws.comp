// Writes the indirect draws, one thread per bin. The items of a bin are adjacent in the work list, so its
// slots are adjacent in the visible list.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#include "formats/gpu_shared/records.h"

layout(local_size_x = kGroupBins) in;

layout(set = kSetTables, binding = kTableBins, std430) readonly buffer Bins { Bin bins[]; };
layout(set = kSetTables, binding = kTableResults, std430) readonly buffer Results { WorkResult results[]; };
layout(set = kSetTables, binding = kTableTotals, std430) readonly buffer Totals { uint totals[]; };
layout(set = kSetTables, binding = kTableBinDraws, std430) writeonly buffer BinDraws { BinDraw bin_draws[]; };
layout(push_constant) uniform Push { EmitDrawsPush push; };

uint slotBeforeItem(uint item)
{
    uint slot = item < push.item_count ? totals[item / kScanBlockItems] + results[item].offset : totals[push.block_count];
    return min(slot, push.slot_capacity);
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.bin_count)
        return;
    uint first = slotBeforeItem(bins[i].first_item);
    uint end = slotBeforeItem(bins[i].first_item + bins[i].item_count);
    BinDraw draw = BinDraw(kClusterVertices, end - first, 0u, 0u, first, 0u, 0u, 0u);
    // the draws of the late phase follow the early draws of all bins
    if (push.phase == kPhaseLate)
        bin_draws[push.bin_count + i] = draw;
    else
    {
        bin_draws[i] = draw;
        bin_draws[push.bin_count + i] = BinDraw(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    }
}
