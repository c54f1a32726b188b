// Layout of clusters in geometry pages: attribute bits, word offsets, and the decoders of positions, normals,
// tangents, UVs, colours, influences, indices and morph deltas. One source for C++ and GLSL;
// formats/codecs/vertex_codec.h defines the codes and encodes them. Frame of a normal: T. Duff et al.,
// "Building an orthonormal basis, revisited", 2017.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_VERTEX_LAYOUT_H
#define HEARTH_SHARED_VERTEX_LAYOUT_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// Bits of the vertex layout of a mesh: its attributes, and how each is coded. A vertex is 32-bit words
/// in this order: position, normal, tangent, UV sets, colour, visibility, joints, weights.
HEARTH_CONSTANT uint kVertexNormal = 1;
HEARTH_CONSTANT uint kVertexTangent = 2; ///< only with a normal
HEARTH_CONSTANT uint kVertexUv0 = 4;
HEARTH_CONSTANT uint kVertexUv1 = 8;
HEARTH_CONSTANT uint kVertexUv2 = 16;
HEARTH_CONSTANT uint kVertexUv3 = 32;
HEARTH_CONSTANT uint kVertexColor = 64;
HEARTH_CONSTANT uint kVertexVisibility = 128;    ///< visibility of the hemisphere; only with a normal
HEARTH_CONSTANT uint kVertexNormal16 = 256;      ///< normal 2 x 16 bits, not 2 x 8; tangent 15 bits, not 7
HEARTH_CONSTANT uint kVertexColor16 = 512;       ///< 4 x 16 bits instead of 4 x 8
HEARTH_CONSTANT uint kVertexWideOffsets = 8192;  ///< of a cluster, never of a mesh: grid offsets of 32 bits
HEARTH_CONSTANT uint kVertexInfluences = 16384;  ///< four joints of the mesh's skin, and their weights
HEARTH_CONSTANT uint kVertexInfluences8 = 32768; ///< eight instead of four; only with kVertexInfluences

HEARTH_CONSTANT uint kVertexUvs = 60; ///< all four sets

/// First bit of four bits for each UV set: n, where the steps of its grid are 2^-n; 0 for floats or no set.
HEARTH_CONSTANT uint kVertexUvStepShift = 16;

/// Unit of the normal deltas of morph targets, in the difference of two orthogonal normals.
HEARTH_CONSTANT float kMorphNormalSteps = 1024.0f;

/// Return the UV sets that have a grid, as bits kVertexUv0 to kVertexUv3.
HEARTH_CONSTEXPR_FUNCTION uint gridUvs(uint layout_bits)
{
    // reduce each four bits to their lowest: set if any of the four is
    uint steps = layout_bits >> kVertexUvStepShift;
    steps |= steps >> 2;
    steps = (steps | steps >> 1) & 0x1111u;
    // bits 0, 4, 8, 12 to bits 0 to 3
    steps |= steps >> 3;
    steps |= steps >> 6;
    return (steps & 15u) * kVertexUv0;
}

/// Return n of UV set `set`, whose grid has steps of 2^-n; 0 for floats.
HEARTH_CONSTEXPR_FUNCTION uint uvFractionBits(uint layout_bits, uint set)
{
    return layout_bits >> (kVertexUvStepShift + 4u * set) & 15u;
}

/// Return 2^-n, n < 127.
HEARTH_CONSTEXPR_FUNCTION float uvStep(uint fraction_bits)
{
    return floatFromBits((127u - fraction_bits) << 23);
}

/// Return the number of words before a cluster's vertices: for each UV set on a grid, u and v of the base
/// grid point.
HEARTH_CONSTEXPR_FUNCTION uint uvBaseWords(uint layout_bits)
{
    return 2u * uint(bitCount(layout_bits & kVertexUvs & gridUvs(layout_bits)));
}

/// Return the number of words from the base of UV set `set` to the cluster's first vertex.
HEARTH_CONSTEXPR_FUNCTION uint uvBaseDistance(uint layout_bits, uint set)
{
    uint before = (kVertexUv0 << set) - 1u;
    return 2u * uint(bitCount(gridUvs(layout_bits) & layout_bits & ~before));
}

/// Return the word of a vertex at which those of its UV sets end that are in the mask `sets`: the next
/// set, or the next attribute, starts there.
HEARTH_CONSTEXPR_FUNCTION uint uvEnd(uint layout_bits, uint sets)
{
    bool wide = (layout_bits & kVertexWideOffsets) != 0u;
    uint words = wide ? 3u : 2u;
    if ((layout_bits & kVertexNormal) != 0u && (layout_bits & (kVertexNormal16 | kVertexWideOffsets)) != 0u)
        words += 1u;
    if ((layout_bits & kVertexTangent) != 0u)
        words += 1u;
    // floats, and offsets of 32 bits, take two words
    return words + uint(bitCount(layout_bits & sets)) +
           uint(bitCount(layout_bits & sets & (wide ? kVertexUvs : ~gridUvs(layout_bits))));
}

/// Return the word with the normal of a vertex that has one.
HEARTH_CONSTEXPR_FUNCTION uint normalWord(uint layout_bits)
{
    uint narrow = (layout_bits & kVertexNormal16) != 0u ? 2u : 1u;
    return (layout_bits & kVertexWideOffsets) != 0u ? 3u : narrow;
}

/// Return the word of the tangent of a vertex that has one.
HEARTH_CONSTEXPR_FUNCTION uint tangentWord(uint layout_bits)
{
    return uvEnd(layout_bits, 0u) - 1u;
}

/// Return the first word of UV set `set` of a vertex that has it.
HEARTH_CONSTEXPR_FUNCTION uint uvWord(uint layout_bits, uint set)
{
    return uvEnd(layout_bits, ((kVertexUv0 << set) - 1u) & kVertexUvs);
}

/// Return the first word of the colour of a vertex that has one.
HEARTH_CONSTEXPR_FUNCTION uint colorWord(uint layout_bits)
{
    return uvEnd(layout_bits, kVertexUvs);
}

/// Return the word of the visibility of a vertex that has one.
HEARTH_CONSTEXPR_FUNCTION uint visibilityWord(uint layout_bits)
{
    uint words = colorWord(layout_bits);
    if ((layout_bits & kVertexColor) != 0u)
        words += (layout_bits & kVertexColor16) != 0u ? 2u : 1u;
    return words;
}

/// Return the first word of the joints of a vertex that has influences.
HEARTH_CONSTEXPR_FUNCTION uint influenceWord(uint layout_bits)
{
    return visibilityWord(layout_bits) + ((layout_bits & kVertexVisibility) != 0u ? 1u : 0u);
}

/// Return the number of influences of one vertex: a joint and a weight of 16 bits each.
HEARTH_CONSTEXPR_FUNCTION uint influencesPerVertex(uint layout_bits)
{
    if ((layout_bits & kVertexInfluences) == 0u)
        return 0u;
    return (layout_bits & kVertexInfluences8) != 0u ? 8u : 4u;
}

/// Return the number of words of one vertex.
HEARTH_CONSTEXPR_FUNCTION uint vertexWords(uint layout_bits)
{
    return influenceWord(layout_bits) + influencesPerVertex(layout_bits);
}

/// Offset of a position from its cluster's base, in grid steps.
struct GridOffset
{
    uint x;
    uint y;
    uint z;
};

/// Unpack a position from the first words of its vertex.
/// third  0 unless the layout has kVertexWideOffsets
HEARTH_CONSTEXPR_FUNCTION GridOffset unpackPosition(uint layout_bits, uint first, uint second, uint third)
{
    bool wide = (layout_bits & kVertexWideOffsets) != 0u;
    GridOffset offset;
    offset.x = wide ? first : first & 0xFFFFu;
    offset.y = wide ? second : first >> 16;
    offset.z = wide ? third : second & 0xFFFFu;
    return offset;
}

/// Offset of a UV from its cluster's base, in steps of its set's grid.
struct UvOffset
{
    uint u;
    uint v;
};

/// Unpack a UV of a set on a grid.
/// second  0 unless the layout has kVertexWideOffsets
HEARTH_CONSTEXPR_FUNCTION UvOffset unpackUv(uint layout_bits, uint first, uint second)
{
    bool wide = (layout_bits & kVertexWideOffsets) != 0u;
    UvOffset offset;
    offset.u = wide ? first : first & 0xFFFFu;
    offset.v = wide ? second : first >> 16;
    return offset;
}

/// Return joint or weight `i` of a vertex, from word i / 2 of its joints or weights.
HEARTH_CONSTEXPR_FUNCTION uint unpackInfluence(uint word, uint i)
{
    return word >> ((i & 1u) * 16u) & 0xFFFFu;
}

/// Return the number of words of a cluster's indices, which follow its vertices: a byte for each corner.
HEARTH_CONSTEXPR_FUNCTION uint indexWords(uint triangle_count)
{
    return (triangle_count * 3u + 3u) / 4u;
}

/// Return the vertex of a corner, from word corner / 4 of the indices. corner: three times the triangle, plus
/// 0 to 2.
HEARTH_CONSTEXPR_FUNCTION uint unpackIndex(uint word, uint corner)
{
    return word >> ((corner & 3u) * 8u) & 0xFFu;
}

/// Return the direction of a point of the square [-1, 1]^2.
HEARTH_FUNCTION Float3 directionFromOctahedral(Float2 p)
{
    Float3 d = Float3(p.x, p.y, 1.0f - abs(p.x) - abs(p.y));
    if (d.z < 0.0f)
    {
        d.x = (1.0f - abs(p.y)) * (p.x < 0.0f ? -1.0f : 1.0f);
        d.y = (1.0f - abs(p.x)) * (p.y < 0.0f ? -1.0f : 1.0f);
    }
    return normalize(d); // |d| >= 1/sqrt(3): never zero
}

/// Return the code of a normal.
/// word  normalWord of the vertex
HEARTH_CONSTEXPR_FUNCTION uint normalCode(uint layout_bits, uint word)
{
    return (layout_bits & (kVertexNormal16 | kVertexWideOffsets)) != 0u ? word : word >> 16;
}

HEARTH_FUNCTION Float3 decodeNormal(uint layout_bits, uint code)
{
    return directionFromOctahedral((layout_bits & kVertexNormal16) != 0u ? unpackSnorm2x16(code)
                                                                         : unpackSnorm2x8(code));
}

/// Return the number of bits of a tangent's angle.
HEARTH_CONSTEXPR_FUNCTION uint tangentAngleBits(uint layout_bits)
{
    return (layout_bits & kVertexNormal16) != 0u ? 15u : 7u;
}

/// Two unit vectors orthogonal to a unit normal and to each other.
struct NormalFrame
{
    Float3 first;
    Float3 second;
};

HEARTH_FUNCTION NormalFrame makeNormalFrame(Float3 normal)
{
    float side = normal.z < 0.0f ? -1.0f : 1.0f;
    float a = -1.0f / (side + normal.z);
    float b = normal.x * normal.y * a;
    NormalFrame frame;
    frame.first = Float3(1.0f + side * normal.x * normal.x * a, side * b, -side * normal.x);
    frame.second = Float3(b, side + normal.y * normal.y * a, -normal.y);
    return frame;
}

/// Decode a tangent: xyz unit, w = +1, or -1 where the bitangent is flipped.
/// normal  as decoded
HEARTH_FUNCTION Float4 decodeTangent(uint layout_bits, uint code, Float3 normal)
{
    uint quarter_bits = tangentAngleBits(layout_bits) - 2u;
    uint angle = code >> 1;
    float along = float(angle & ((1u << quarter_bits) - 1u)) / float(1u << quarter_bits);
    uint turn = angle >> quarter_bits;
    float u = (turn & 1u) == 0u ? 1.0f - along : -along;
    float v = (turn & 1u) == 0u ? along : 1.0f - along;
    if (turn >= 2u)
    {
        u = -u;
        v = -v;
    }
    NormalFrame frame = makeNormalFrame(normal);
    Float3 unit = normalize(frame.first * u + frame.second * v);
    return Float4(unit.x, unit.y, unit.z, (code & 1u) != 0u ? -1.0f : 1.0f);
}

/// Decode a colour: linear RGBA.
/// second  0 unless the layout has kVertexColor16
HEARTH_FUNCTION Float4 decodeColor(uint layout_bits, uint first, uint second)
{
    if ((layout_bits & kVertexColor16) == 0u)
        return unpackUnorm4x8(first);
    Float2 red_green = unpackUnorm2x16(first);
    Float2 blue_alpha = unpackUnorm2x16(second);
    return Float4(red_green.x, red_green.y, blue_alpha.x, blue_alpha.y);
}

/// Return the word of the morph section with the number of the mesh's target that is the cluster's target
/// `i`. The section follows the indices: the number n of the cluster's targets, n times { target, step of its
/// position deltas as a float }, then three words for each vertex of each target.
HEARTH_CONSTEXPR_FUNCTION uint morphTargetWord(uint i)
{
    return 1u + 2u * i;
}

/// Return the word of the morph section with the step of the position deltas of target `i`.
HEARTH_CONSTEXPR_FUNCTION uint morphStepWord(uint i)
{
    return 2u + 2u * i;
}

/// Return the first of the three words of the morph section with the deltas of a vertex for target `i`.
HEARTH_CONSTEXPR_FUNCTION uint morphDeltaWord(uint target_count, uint vertex_count, uint i, uint vertex)
{
    return morphTargetWord(target_count) + (i * vertex_count + vertex) * 3u;
}

/// Return the position delta of a word of a morph target, in steps.
HEARTH_CONSTEXPR_FUNCTION int morphPosition(uint word)
{
    return int(word << 12) >> 12;
}

/// Return the normal delta of a word of a morph target, in units of 1 / kMorphNormalSteps.
HEARTH_CONSTEXPR_FUNCTION int morphNormal(uint word)
{
    return int(word) >> 20;
}

HEARTH_SHARED_END

#endif
