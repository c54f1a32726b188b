// Encodes the vertices of geometry pages: codes of positions, normals, tangents, UVs and colours. Their
// layout and decoders are in formats/gpu_shared/vertex_layout.h, which shaders share; the bit definitions
// are in FORMAT.md. Octahedral map: Q. Meyer et al., "On floating-point normal vectors", 2010; its
// rounding: Z. Cigolle et al., "A survey of efficient representations for independent unit vectors",
// 2014.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"
#include "formats/gpu_shared/vertex_layout.h"
#include "formats/records/mesh.h"

#include <array>
#include <bit>
#include <cstdint>

// Only + - * / and sqrt on 32-bit floats are used, each rounded once: every machine gets the same bits.
//
//   position     (base + offset) * grid_step: integers of at most 24 bits times a power of two, exact as
//                floats. The base is the cluster's, offsets are 3 x u16, x in the lowest bits, or 3 x u32 in
//                a wide cluster.
//   snorm B bits q in [-m, m], m = 2^(B-1) - 1, decodes to q / m; -m - 1 is not a legal code
//   normal       octahedral: x and y, snorm8 or snorm16, x in the low half.
//                z = 1 - |x| - |y|;  where z < 0: (x, y) becomes ((1 - |y|) * sign(x), (1 - |x|) * sign(y)),
//                sign(0) = +1; the direction is normalize(x, y, z). All legal codes are directions.
//   tangent      bit 0: the bitangent is flipped, bitangent = (flipped ? -1 : 1) * cross(normal, tangent);
//                above it the angle about the decoded normal, 7 or 15 bits: its top two bits are a quarter
//                turn, the rest interpolate linearly between the two axes of the normal's frame
//   UV           floats, or (base + offset) * 2^-n, the base the cluster's, offsets 2 x u16, or 2 x u32 in a
//                wide cluster
//   colour       4 x unorm8 or unorm16, linear RGBA: q / 255 or q / 65535
//   visibility   visibility_code.h
//   influences   4 or 8 joints of the skin as u16, two a word, then as many weights, unorm16, in descending
//                order; their codes sum to exactly 65535; a joint without weight is 0
//
// Morph section of a cluster, in words:
//   n            number of the mesh's targets that move a vertex of the cluster
//   n x          { the target's number, ascending; the step of its position deltas, f32 }
//   n x          for each vertex three words x, y, z: the lower 20 bits are the position delta, signed, in
//                steps; the upper 12 bits the normal delta, signed, in units of 1 / 1024

namespace hearth::formats
{

/// Mask of the attribute bits.
inline constexpr uint32_t kVertexAttributesAll = 255;

/// Grid coordinates are integers in [-kMaxGridCoordinate, kMaxGridCoordinate]: floats represent all of them.
inline constexpr int32_t kMaxGridCoordinate = 1 << 24;

/// Largest distance in steps from a cluster's base that a 16-bit offset reaches.
inline constexpr int64_t kMaxNarrowOffset = 65535;

// of a layout, a code or a word
using shared::decodeNormal;
using shared::decodeTangent;
using shared::directionFromOctahedral;
using shared::kMorphNormalSteps;
using shared::makeNormalFrame;
using shared::morphNormal;
using shared::morphPosition;
using shared::NormalFrame;
using shared::tangentAngleBits;
using shared::uvFractionBits;
using shared::uvStep;

/// True if the layout is legal for a mesh: unused bits are 0, no coding bit is set for an absent attribute,
/// and tangents and visibility require normals.
constexpr bool isLegalLayout(uint32_t layout)
{
    constexpr uint32_t kOfMeshes = kVertexAttributesAll | kVertexNormal16 | kVertexColor16 |
                                   kVertexInfluenceBits | 0xFFFFu << kVertexUvStepShift;
    constexpr uint32_t kBesideNormals = kVertexTangent | kVertexVisibility | kVertexNormal16;
    return (layout & ~kOfMeshes) == 0 && (layout & kVertexInfluenceBits) != kVertexInfluences8 &&
           (gridUvs(layout) & ~layout) == 0 &&
           ((layout & kVertexNormal) != 0 || (layout & kBesideNormals) == 0) &&
           ((layout & kVertexColor) != 0 || (layout & kVertexColor16) == 0);
}

/// Return the first word of attribute `bit` in a vertex with this layout; `bit` is an attribute bit, or
/// kVertexInfluences. Positions are at 0; a normal without a word of its own is the upper half of word 1.
constexpr uint32_t attributeWord(uint32_t layout, uint32_t bit)
{
    const bool shares_word = bit == kVertexNormal && (layout & (kVertexNormal16 | kVertexWideOffsets)) == 0;
    const uint32_t before = ((bit - 1) | ~kVertexAttributesAll) & ~kVertexInfluenceBits;
    return shares_word ? 1 : vertexWords(layout & before);
}

/// Return the word of UV set `set`'s base among the uvBaseWords before a cluster's vertices.
constexpr uint32_t uvBaseWord(uint32_t layout, uint32_t set)
{
    return uvBaseWords(layout) - shared::uvBaseDistance(layout, set);
}

/// Return the bytes of a cluster in its page, without its morph section: UV bases, vertices, then three u8
/// indices for each triangle, padded with zeros to words.
constexpr uint32_t clusterBytes(uint32_t layout, uint32_t vertex_count, uint32_t triangle_count)
{
    return 4 *
           (uvBaseWords(layout) + vertex_count * vertexWords(layout) + shared::indexWords(triangle_count));
}

/// Return the layout with these attributes that needs the most bytes.
constexpr uint32_t worstCaseLayout(uint32_t attributes)
{
    uint32_t layout = (attributes & (kVertexAttributesAll | kVertexInfluenceBits)) | kVertexNormal16 |
                      kVertexColor16 | kVertexWideOffsets;
    // as floats, a UV takes two words, but a grid also has a base
    for (uint32_t set = 0; set < 4; ++set)
        if (attributes & kVertexUv0 << set)
            layout |= 1u << (kVertexUvStepShift + 4 * set);
    return layout;
}

/// Return the number of words of a morph section with `targets` targets.
constexpr size_t morphSectionWords(size_t targets, size_t vertex_count)
{
    return 1 + targets * (2 + 3 * vertex_count);
}

inline constexpr int32_t kMaxMorphPositionSteps = (1 << 19) - 1;

/// Pack the deltas of a position, in [-2^19, 2^19), and of a normal, in [-2^11, 2^11).
constexpr uint32_t packMorphDelta(int32_t position, int32_t normal)
{
    return (static_cast<uint32_t>(position) & 0xFFFFFu) | static_cast<uint32_t>(normal) << 20;
}

constexpr uint32_t packHalves(int32_t low, int32_t high)
{
    return (static_cast<uint32_t>(low) & 0xFFFFu) | static_cast<uint32_t>(high) << 16;
}
constexpr int32_t lowHalf(uint32_t word)
{
    return static_cast<int16_t>(word & 0xFFFFu);
}
constexpr int32_t highHalf(uint32_t word)
{
    return static_cast<int16_t>(word >> 16);
}

/// Return the nearest unorm code of q / most; values outside [0, 1] are clamped.
inline uint32_t quantizeUnorm(float value, float most)
{
    return static_cast<uint32_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * most));
}

/// Return the position of a grid coordinate; exact for |coordinate| <= kMaxGridCoordinate.
inline float gridToFloat(int32_t coordinate, float step)
{
    return static_cast<float>(coordinate) * step;
}

/// Return the point of the square [-1, 1]^2 for a direction of any length > 0.
inline Float2 octahedralFromDirection(Float3 d)
{
    const float sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    Float2 p{d.x / sum, d.y / sum};
    if (d.z < 0)
        p = {(1.0f - std::abs(p.y)) * (p.x < 0 ? -1.0f : 1.0f),
             (1.0f - std::abs(p.x)) * (p.y < 0 ? -1.0f : 1.0f)};
    return p;
}

using FourFloats = float __attribute__((vector_size(16)));

/// Return, for four points of the square, the squared distance of directionFromOctahedral to `unit`, to the
/// same bits.
inline FourFloats distance2ToOctahedral(FourFloats x, FourFloats y, Float3 unit)
{
    using FourWords = uint32_t __attribute__((vector_size(16)));
    constexpr uint32_t kSign = 1u << 31;
    const auto magnitude = [](FourFloats v)
    { return std::bit_cast<FourFloats>(std::bit_cast<FourWords>(v) & ~kSign); };
    // neither code is -0
    const auto towards = [](FourFloats v, FourFloats sign) {
        return std::bit_cast<FourFloats>(std::bit_cast<FourWords>(v) ^
                                         (std::bit_cast<FourWords>(sign) & kSign));
    };
    const FourFloats z = 1.0f - magnitude(x) - magnitude(y);
    const FourFloats folded_x = z < 0 ? towards(1.0f - magnitude(y), x) : x;
    const FourFloats folded_y = z < 0 ? towards(1.0f - magnitude(x), y) : y;
    const FourFloats length2 = folded_x * folded_x + folded_y * folded_y + z * z;
    const FourFloats length{std::sqrt(length2[0]), std::sqrt(length2[1]), std::sqrt(length2[2]),
                            std::sqrt(length2[3])};
    const FourFloats off_x = folded_x / length - unit.x;
    const FourFloats off_y = folded_y / length - unit.y;
    const FourFloats off_z = z / length - unit.z;
    return off_x * off_x + off_y * off_y + off_z * off_z;
}

/// Normal code of B = 8 or 16 bits for x and for y: 2B bits, x in the low half.
template <int B>
struct NormalCode
{
    static constexpr int32_t kMaxCode = (1 << (B - 1)) - 1;

    static constexpr int32_t x(uint32_t code) { return static_cast<int32_t>(code << (32 - B)) >> (32 - B); }
    static constexpr int32_t y(uint32_t code) { return x(code >> B); }
    static constexpr uint32_t pack(int32_t x, int32_t y)
    {
        constexpr uint32_t kMask = (1u << B) - 1;
        return (static_cast<uint32_t>(x) & kMask) | (static_cast<uint32_t>(y) & kMask) << B;
    }
    static constexpr bool legal(uint32_t code) { return x(code) >= -kMaxCode && y(code) >= -kMaxCode; }

    static Float3 decode(uint32_t code) { return decodeNormal(B == 16 ? kVertexNormal16 : 0, code); }

    /// Encode a normal: the code with the smallest angle of the four around the direction. `normal` is finite
    /// and not zero.
    static uint32_t encode(Float3 normal)
    {
        const Float2 p = octahedralFromDirection(normal);
        const Float3 unit = normal / length(normal);
        const auto below = [](float value)
        {
            const auto nearer_to_0 = static_cast<int32_t>(value * kMaxCode);
            return std::clamp(nearer_to_0 - (value < 0 ? 1 : 0), -kMaxCode, kMaxCode - 1);
        };
        const int32_t low_x = below(p.x);
        const int32_t low_y = below(p.y);
        const auto x0 = static_cast<float>(low_x), y0 = static_cast<float>(low_y);
        // the chord: unlike the cosine, it resolves the smallest angles in floats
        const FourFloats distance2 =
            distance2ToOctahedral(FourFloats{x0, x0 + 1, x0, x0 + 1} / static_cast<float>(kMaxCode),
                                  FourFloats{y0, y0, y0 + 1, y0 + 1} / static_cast<float>(kMaxCode), unit);
        int32_t best = 0;
        for (int32_t corner = 1; corner < 4; ++corner)
            best = distance2[corner] < distance2[best] ? corner : best;
        return pack(low_x + (best & 1), low_y + (best >> 1));
    }
};

/// Encode a normal in 16 bits (2 x 8), or 32 (2 x 16) in a layout with kVertexNormal16.
inline uint32_t encodeNormal(uint32_t layout, Float3 normal)
{
    return (layout & kVertexNormal16) ? NormalCode<16>::encode(normal) : NormalCode<8>::encode(normal);
}
constexpr bool isLegalNormal(uint32_t layout, uint32_t code)
{
    return (layout & kVertexNormal16) ? NormalCode<16>::legal(code)
                                      : code <= 0xFFFF && NormalCode<8>::legal(code);
}

/// Encode a tangent. `tangent` xyz is finite, w < 0 if the bitangent is flipped; `normal` as decoded. The
/// tangent's component along the normal is lost; a tangent along the normal gets the frame's first vector.
inline uint32_t encodeTangent(uint32_t layout, Float4 tangent, Float3 normal)
{
    const NormalFrame frame = makeNormalFrame(normal);
    const Float3 t{tangent.x, tangent.y, tangent.z};
    const float u = dot(t, frame.first);
    const float v = dot(t, frame.second);
    const float sum = std::abs(u) + std::abs(v);
    // quarter turns, then the fraction from one axis to the next
    float turn = 0;
    if (sum > 0)
        turn = v >= 0 ? (u >= 0 ? v / sum : 1 - u / sum) : (u < 0 ? 2 - v / sum : 3 + u / sum);
    const uint32_t quarter = 1u << (tangentAngleBits(layout) - 2);
    const auto angle = static_cast<uint32_t>(std::lround(turn * static_cast<float>(quarter)));
    return (angle & (4 * quarter - 1)) << 1 | (tangent.w < 0 ? 1u : 0u);
}

constexpr bool isLegalTangent(uint32_t layout, uint32_t code)
{
    return code >> (tangentAngleBits(layout) + 1) == 0;
}

/// Return the words of a colour: red in the lowest bits. The second word is 0 and not stored unless the
/// layout has kVertexColor16.
inline std::array<uint32_t, 2> encodeColor(uint32_t layout, Float4 color)
{
    if (layout & kVertexColor16)
        return {quantizeUnorm(color.x, 65535) | quantizeUnorm(color.y, 65535) << 16,
                quantizeUnorm(color.z, 65535) | quantizeUnorm(color.w, 65535) << 16};
    return {quantizeUnorm(color.x, 255) | quantizeUnorm(color.y, 255) << 8 |
                quantizeUnorm(color.z, 255) << 16 | quantizeUnorm(color.w, 255) << 24,
            0};
}

inline Float4 decodeColor(uint32_t layout, std::array<uint32_t, 2> words)
{
    return shared::decodeColor(layout, words[0], words[1]);
}

} // namespace hearth::formats
