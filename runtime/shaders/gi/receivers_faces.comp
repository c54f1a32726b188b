// Updates the baked light of the faces of bricks by the weights that lamps have in a frame. A workgroup has a
// block, a thread a face.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/receivers/receivers.h"
#include "runtime/shaders/gi/receivers_sum.glsl"

layout(local_size_x = kReceiverBlockTexels) in;

layout(set = kSetReceivers, binding = kReceiversFaces, std430) writeonly buffer Faces { uint faces[]; };
layout(push_constant) uniform Push { ReceiversPush push; };

void main()
{
    ReceiverBlock block = blocks[push.first_block + gl_WorkGroupID.x];
    if (gl_LocalInvocationIndex >= block.texel_count)
        return;
    uvec2 place;
    uint word = sumReceiver(block, gl_LocalInvocationIndex, push.first_weight, push.codec, place);
    faces[push.first_face + encodeReceiverPlace(place.x, place.y)] = word;
}
