// Light of a texel of receivers: the sum of what each lamp gives, by its weight, as the words of the atlas
// have it. It has the bytes of receiver_light.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

layout(set = kSetReceivers, binding = kReceiversBlocks, std430) readonly buffer Blocks { ReceiverBlock blocks[]; };
layout(set = kSetReceivers, binding = kReceiversWords, std430) readonly buffer Words { uint words[]; };
layout(set = kSetReceivers, binding = kReceiversWeights, std430) readonly buffer Weights { vec4 weights[]; };

/// texel         number in the block
/// first_weight  of the frame
/// place         set to that in the atlas
uint sumReceiver(ReceiverBlock block, uint texel, uint first_weight, uint codec, out uvec2 place)
{
    uint word = block.first_word + texel;
    place = uvec2(receiverX(words[word]), receiverY(words[word]));
    bool drops = (words[word] & kReceiverDrops) != 0u;
    vec3 sum = vec3(0.0);
    for (uint color = 0u; color < block.color_count; ++color)
    {
        word += block.texel_count;
        vec3 weight = weights[first_weight + receiverLamp(block, color)].xyz;
        sum = addReceiverLight(sum, weight, decodeReceiverColor(words[word], codec & kReceiverRgbm));
    }
    if ((codec & kReceiverShowsDrops) != 0u && drops)
        sum = vec3(max(sum.r, max(sum.g, sum.b)), 0.0, 0.0);
    return encodeSharedExponentWord(sum);
}
