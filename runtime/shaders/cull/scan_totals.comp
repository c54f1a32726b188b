// Exclusive prefix sum over the totals of all blocks, in one workgroup. The grand total is stored after the
// last one. The late phase continues after the slots of the early phase.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#include "formats/gpu_shared/records.h"
#include "runtime/shaders/cull/scan.glsl"

layout(local_size_x = kScanThreads) in;

layout(set = kSetTables, binding = kTableTotals, std430) buffer Totals { uint totals[]; };
layout(set = kSetTables, binding = kTableCounters, std430) buffer Counters { FrameCounters counters; };
layout(push_constant) uniform Push { ScanTotalsPush push; };

void main()
{
    uint early = push.phase == kPhaseLate ? counters.drawn_clusters : 0u;
    uint sum = early;
    for (uint first = 0u; first < push.block_count; first += kScanThreads)
    {
        uint i = first + gl_LocalInvocationIndex;
        uint value = i < push.block_count ? totals[i] : 0u;
        uint total;
        uint offset = exclusiveScan(value, total);
        if (i < push.block_count)
            totals[i] = sum + offset;
        sum += total;
    }
    barrier(); // all have read the counters
    if (gl_LocalInvocationIndex == 0u)
    {
        totals[push.block_count] = sum;
        counters = FrameCounters(sum, sum > push.slot_capacity ? sum - push.slot_capacity : 0u, push.phase == kPhaseLate ? early : sum, 0u);
    }
}
