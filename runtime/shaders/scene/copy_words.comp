// Copies words from buffer to buffer, one workgroup per region.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#include "formats/gpu_shared/records.h"

layout(local_size_x = kGroupCopyWords) in;

layout(set = kSetWordCopy, binding = kWordCopyRegions, std430) readonly buffer Regions { CopyRegion regions[]; };
layout(set = kSetWordCopy, binding = kWordCopySource, std430) readonly buffer Source { uint source[]; };
layout(set = kSetWordCopy, binding = kWordCopyTarget, std430) writeonly buffer Target { uint target[]; };
layout(push_constant) uniform Push { WordCopyPush push; };

void main()
{
    CopyRegion region = regions[push.first_region + gl_WorkGroupID.x];
    for (uint i = gl_LocalInvocationIndex; i < region.words; i += kGroupCopyWords)
        target[region.target + i] = source[region.source + i];
}
