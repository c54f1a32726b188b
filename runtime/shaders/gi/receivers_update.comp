// Updates the texels of blocks of receivers: the sum of what each lamp gives, by its weight. A workgroup has
// a block, a thread a texel. Reads nothing of the image, and gives the bytes of receiver_light.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/receivers/receivers.h"

layout(local_size_x = kReceiverBlockTexels) in;

layout(set = kSetReceivers, binding = kReceiversBlocks, std430) readonly buffer Blocks { ReceiverBlock blocks[]; };
layout(set = kSetReceivers, binding = kReceiversWords, std430) readonly buffer Words { uint words[]; };
layout(set = kSetReceivers, binding = kReceiversWeights, std430) readonly buffer Weights { vec4 weights[]; };
layout(set = kSetReceivers, binding = kReceiversTexels, r32ui) uniform writeonly uimage2D texels;
layout(push_constant) uniform Push { ReceiversPush push; };

void main()
{
    ReceiverBlock block = blocks[push.first_block + gl_WorkGroupID.x];
    if (gl_LocalInvocationIndex >= block.texel_count)
        return;
    uint word = block.first_word + gl_LocalInvocationIndex;
    uint place = words[word];
    vec3 sum = vec3(0.0);
    for (uint color = 0u; color < block.color_count; ++color)
    {
        word += block.texel_count;
        vec3 weight = weights[push.first_weight + receiverLamp(block, color)].xyz;
        sum = addReceiverLight(sum, weight, decodeReceiverColor(words[word], push.codec));
    }
    imageStore(texels, ivec2(receiverX(place), receiverY(place)), uvec4(encodeSharedExponentWord(sum)));
}
