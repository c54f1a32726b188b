// Exclusive prefix sum over the totals of all blocks, in one workgroup. The grand total is stored after the
// last one. The late phase continues after the slots of the early phase.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/records.h"
#include "runtime/shaders/cull/scan.glsl"

layout(local_size_x = 256) in;

layout(set = 0, binding = 0, std430) buffer Totals { uint totals[]; };
layout(set = 0, binding = 1, std430) buffer Counters { FrameCounters counters; };
layout(push_constant) uniform Push
{
    uint block_count;
    uint slot_capacity;
    uint phase;
};

void main()
{
    uint early = phase == kPhaseLate ? counters.drawn_clusters : 0u;
    uint sum = early;
    for (uint first = 0u; first < block_count; first += 256u)
    {
        uint i = first + gl_LocalInvocationIndex;
        uint value = i < block_count ? totals[i] : 0u;
        uint total;
        uint offset = exclusiveScan256(value, total);
        if (i < block_count)
            totals[i] = sum + offset;
        sum += total;
    }
    barrier(); // all have read the counters
    if (gl_LocalInvocationIndex == 0u)
    {
        totals[block_count] = sum;
        counters = FrameCounters(sum, sum > slot_capacity ? sum - slot_capacity : 0u, phase == kPhaseLate ? early : sum, 0u);
    }
}
