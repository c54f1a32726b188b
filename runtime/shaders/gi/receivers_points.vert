// Updates the texels of blocks of receivers by points: an instance is a block, a vertex one of its texels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/receivers/receiver_points.h"
#include "runtime/shaders/gi/receivers_sum.glsl"

layout(push_constant) uniform Push { ReceiverPointsPush push; };
layout(location = 0) flat out uint word;

void main()
{
    ReceiverBlock block = blocks[push.first_block + gl_InstanceIndex];
    gl_PointSize = 1.0;
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0); // outside of the view
    word = 0u;
    if (gl_VertexIndex >= block.texel_count)
        return;
    uvec2 place;
    word = sumReceiver(block, gl_VertexIndex, push.first_weight, push.codec, place);
    gl_Position.xy = (vec2(place) + 0.5) * vec2(push.texel_width, push.texel_height) - 1.0;
}
