// Exclusive prefix sum of drawn clusters over the work items of one block. Passes the total of the block to
// scan_totals.comp.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#include "formats/gpu_shared/records.h"
#include "runtime/shaders/cull/scan.glsl"

layout(local_size_x = kScanThreads) in;

layout(set = kSetTables, binding = kTableResults, std430) buffer Results { WorkResult results[]; };
layout(set = kSetTables, binding = kTableTotals, std430) writeonly buffer Totals { uint totals[]; };
layout(push_constant) uniform Push { ScanBlocksPush push; };

const uint kItemsPerThread = kScanBlockItems / kScanThreads;

void main()
{
    uint first = gl_WorkGroupID.x * kScanBlockItems + gl_LocalInvocationIndex * kItemsPerThread;
    uint counts[kItemsPerThread];
    uint sum = 0u;
    for (uint i = 0u; i < kItemsPerThread; ++i)
    {
        counts[i] = 0u;
        if (first + i < push.item_count)
            counts[i] = uint(bitCount(results[first + i].mask_low) + bitCount(results[first + i].mask_high));
        sum += counts[i];
    }
    uint total;
    uint offset = exclusiveScan(sum, total);
    for (uint i = 0u; i < kItemsPerThread; ++i)
    {
        if (first + i < push.item_count)
            results[first + i].offset = offset;
        offset += counts[i];
    }
    if (gl_LocalInvocationIndex == 0u)
        totals[gl_WorkGroupID.x] = total;
}
