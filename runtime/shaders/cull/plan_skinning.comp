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
    DeformationHeader header = readDeformationHeader();
    uint before = 0u;
    if (push.phase == kPhaseLate)
    {
        before = min(header.early_end - header.early_first, header.block_count);
        header.late_first = first;
    }
    else
    {
        header.early_first = first;
        header.early_end = end;
        header.late_first = end;
    }
    header.late_end = end;
    header.group_count = min(end - first, header.block_count - before);
    header.groups_x = min(header.group_count, kMaxDispatchX);
    header.groups_y = (header.group_count + kMaxDispatchX - 1u) / kMaxDispatchX;
    header.groups_z = 1u;
    writeSkinningPlan(header);
}
