// Finds the slots of the visible list with deformed clusters, and how many of them fit into the scratch
// buffer of skinned vertices. One thread; runs after each culling phase. The bins of deformed clusters are
// the last ones.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#define DEFORMATION_SET kSetTables
#define DEFORMATION_BINDING kTableDeformation
#define DEFORMATION_WRITES
#include "runtime/shaders/scene/deformation.glsl"

layout(local_size_x = 1) in;

layout(set = kSetTables, binding = kTableBinDraws, std430) readonly buffer BinDraws { BinDraw bin_draws[]; };
layout(push_constant) uniform Push { SkinningPlanPush push; };

void main()
{
    uint bins = push.phase == kPhaseLate ? push.bin_count : 0u;
    BinDraw last = bin_draws[bins + push.bin_count - 1u];
    uint first = bin_draws[bins + push.first_bin].first_slot;
    uint end = last.first_slot + last.instance_count;
    uvec4 slots = push.phase == kPhaseLate ? uvec4(deformation[1].xy, first, end) : uvec4(first, end, end, end);
    uint before = push.phase == kPhaseLate ? min(slots.y - slots.x, deformation[0].w) : 0u;
    uint count = min(end - first, deformation[0].w - before);
    deformation[1] = slots;
    deformation[2] = uvec4(min(count, kMaxDispatchX), (count + kMaxDispatchX - 1u) / kMaxDispatchX, 1u, count);
}
