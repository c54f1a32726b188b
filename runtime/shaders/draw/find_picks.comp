// Looks up the triangles that the pixels of a rectangle show, row by row: one thread per pixel.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/queries/picks.h"
#include "formats/gpu_shared/push_constants.h"
#include "formats/gpu_shared/records.h"

layout(local_size_x = kGroupPicks) in;

layout(set = kSetTables, binding = kTableVisible, std430) readonly buffer Visible { VisibleCluster visible[]; };
layout(set = kSetTables, binding = kTablePicks, std430) writeonly buffer Picks { Pick picks[]; };
layout(set = kSetPickPixels, binding = kPixelsVisibility) uniform usampler2D visibility;
layout(push_constant) uniform Push { PickPush push; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.width * push.height)
        return;
    ivec2 pixel = ivec2(push.x + i % push.width, push.y + i / push.width);
    uint id = texelFetch(visibility, pixel, 0).x;
    Pick pick = Pick(kNothingPicked, 0u, 0u, 0u);
    if (id != kVisibilitySky)
    {
        VisibleCluster slot = visible[id >> kTriangleBits];
        pick = Pick(slot.instance, slot.cluster, id & ((1u << kTriangleBits) - 1u), 0u);
    }
    picks[i] = pick;
}
