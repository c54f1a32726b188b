// Texels of baked light whose lamps keep weights of their own: blocks of texels, colours, and the sum over
// lamps. One source for C++ and GLSL, to the same bits. FORMAT.md, "Receivers", has the layouts.
// Source: X. Guo and T. Li, "Practical High-Performance Rendering on Mobile Platforms", GDC 2023; Vulkan 1.3,
// "RGB to shared exponent".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_RECEIVERS_H
#define HEARTH_SHARED_RECEIVERS_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// Texels of a block, at most: one workgroup updates a block.
HEARTH_CONSTANT uint kReceiverBlockTexels = 64;
/// Colours of a texel, at most: four times the three of the talk.
HEARTH_CONSTANT uint kMaxReceiverColors = 12;
/// Bits of each coordinate of a texel.
HEARTH_CONSTANT uint kReceiverSideBits = 14;
/// Width and height of an atlas, at most.
HEARTH_CONSTANT uint kMaxReceiverSide = 16384;
/// Groups of texels that may be updated in different frames.
HEARTH_CONSTANT uint kReceiverGroups = 4;

/// Codecs of stored colours.
HEARTH_CONSTANT uint kReceiverRgb9e5 = 0; ///< shared exponent, as texels of E5B9G9R9
HEARTH_CONSTANT uint kReceiverRgbm = 1;   ///< bytes r, g, b, m: (6 r m)^2

/// Bit of a texel's place: it does not keep a lamp with more than kMaxUnseenDrop of its light.
HEARTH_CONSTANT uint kReceiverDrops = 1u << 28;
HEARTH_CONSTANT float kMaxUnseenDrop = 0.02f;

/// Set of the update, and its bindings.
HEARTH_CONSTANT uint kSetReceivers = 0;
HEARTH_CONSTANT uint kReceiversBlocks = 0;
HEARTH_CONSTANT uint kReceiversWords = 1;
HEARTH_CONSTANT uint kReceiversWeights = 2; ///< four floats for each lamp, the last unused
HEARTH_CONSTANT uint kReceiversTexels = 3;
HEARTH_CONSTANT uint kReceiversFaces = 4; ///< light of the faces of bricks, in words

/// Bit of ReceiversPush::codec: texels with kReceiverDrops are red.
HEARTH_CONSTANT uint kReceiverShowsDrops = 2;

/// Push constants of the update.
struct ReceiversPush
{
    uint first_block;
    uint first_weight;
    uint codec;      ///< kReceiverRgb9e5 or kReceiverRgbm; for a view kReceiverShowsDrops, too
    uint first_face; ///< word of the first face; of texels 0
};

/// Up to 64 texels of one update group that the same lamps reach. Its words are the places of the texels,
/// then the colours of the first lamp at each of them, those of the second, and so on.
struct ReceiverBlock
{
    uint first_word;
    uint texel_count;
    uint color_count;
    uint group;
    uint lamps[6]; ///< two a word, the first in the lower half
};

/// Return the place of a texel. Faces of bricks are texels in rows of kMaxReceiverSide, so that the place of
/// a face is its number.
HEARTH_FUNCTION uint encodeReceiverPlace(uint x, uint y)
{
    return x | y << kReceiverSideBits;
}
HEARTH_FUNCTION uint receiverX(uint place)
{
    return place & (kMaxReceiverSide - 1u);
}
HEARTH_FUNCTION uint receiverY(uint place)
{
    return place >> kReceiverSideBits & (kMaxReceiverSide - 1u);
}

/// Return the face of bricks at a place.
HEARTH_FUNCTION uint receiverFace(uint place)
{
    return place & (kReceiverDrops - 1u);
}

/// Return the update group of a texel: its place among 2 x 2 texels.
HEARTH_FUNCTION uint receiverGroup(uint x, uint y)
{
    return (x & 1u) | (y & 1u) << 1;
}

/// Return the lamp of a block's colour.
HEARTH_FUNCTION uint receiverLamp(HEARTH_IN(ReceiverBlock) block, uint color)
{
    return block.lamps[color >> 1] >> (16u * (color & 1u)) & 0xFFFFu;
}

/// Decode a texel of E5B9G9R9: mantissas of 9 bits from the lowest bit on, then the exponent. Exact.
HEARTH_FUNCTION Float3 decodeSharedExponentWord(uint word)
{
    float step = floatFromBits(((word >> 27) + 103u) << 23); // 2^(exponent - 24)
    return Float3(float(word & 511u) * step, float(word >> 9 & 511u) * step, float(word >> 18 & 511u) * step);
}

/// Round a value below 2^24 to the nearest integer, halves up.
HEARTH_FUNCTION uint roundHalfUp(float value)
{
    uint below = uint(value);
    return value - float(below) >= 0.5f ? below + 1u : below;
}

/// Limit a channel to what RGB9E5 holds; NaN becomes 0.
HEARTH_FUNCTION float limitSharedExponent(float value)
{
    return value > 0.0f ? min(value, 65408.0f) : 0.0f;
}

/// Encode a colour as a texel of E5B9G9R9, to the nearest steps of its largest channel's exponent. Channels
/// below 0 and NaN become 0, those above 65408 become it. Only powers of two are multiplied: exact.
HEARTH_FUNCTION uint encodeSharedExponentWord(Float3 color)
{
    float red = limitSharedExponent(color.x);
    float green = limitSharedExponent(color.y);
    float blue = limitSharedExponent(color.z);
    float largest = max(red, max(green, blue));
    uint bits = floatBits(largest) >> 23; // exponent of a float: 127 more than the logarithm
    uint exponent = bits < 111u ? 0u : bits - 111u;
    if (largest == 0.0f)
        return 0u;
    float steps = floatFromBits((151u - exponent) << 23); // 2^(24 - exponent)
    if (roundHalfUp(largest * steps) == 512u)
    {
        exponent += 1u;
        steps *= 0.5f;
    }
    return exponent << 27 | roundHalfUp(blue * steps) << 18 | roundHalfUp(green * steps) << 9 |
           roundHalfUp(red * steps);
}

/// Decode bytes r, g, b, m: (6 q m)^2 of fractions of 255.
HEARTH_FUNCTION Float3 decodeRgbmWord(uint word)
{
    uint factor = word >> 24;
    HEARTH_PRECISE Float3 root = Float3(float((word & 255u) * factor), float((word >> 8 & 255u) * factor),
                                        float((word >> 16 & 255u) * factor)) *
                                 (6.0f / 65025.0f);
    HEARTH_PRECISE Float3 color = root * root;
    return color;
}

/// Decode a stored colour.
/// codec  kReceiverRgb9e5 or kReceiverRgbm
HEARTH_FUNCTION Float3 decodeReceiverColor(uint word, uint codec)
{
    if (codec == kReceiverRgbm)
        return decodeRgbmWord(word);
    return decodeSharedExponentWord(word);
}

/// Add the light of a lamp. Texels add their colours in the order of the block, beginning with 0.
HEARTH_FUNCTION Float3 addReceiverLight(Float3 sum, Float3 weight, Float3 color)
{
    HEARTH_PRECISE Float3 light = weight * color;
    HEARTH_PRECISE Float3 result = sum + light;
    return result;
}

HEARTH_SHARED_END

#endif
