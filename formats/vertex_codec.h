// How a vertex lies in a geometry page: word offsets, and the packing of normals, tangents and colours.
// Octahedral map: Q. Meyer et al., "On floating-point normal vectors", 2010. The bit definitions are in FORMAT.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/math.h"
#include "formats/mesh.h"

#include <bit>
#include <cstdint>

// Only + - * / and sqrt on 32-bit floats are used, each rounded once: every machine gets the same bits.
//
//   snorm16  q in [-32767, 32767] stands for q / 32767; -32768 (0x8000) is not a legal code
//   unorm16  q in [0, 65535] stands for q / 65535
//   octahedral word: bits 0..15 = x, bits 16..31 = y, both snorm16.
//       z = 1 - |x| - |y|;  where z < 0: (x, y) becomes ((1 - |y|) * sign(x), (1 - |x|) * sign(y)), sign(0) = +1;
//       the direction is normalize(x, y, z). All legal codes are directions.
//   tangent word: the same, and bit 16 (the lowest of y) is 1 where the bitangent is flipped,
//       bitangent = (flipped ? -1 : 1) * cross(normal, tangent). The bit is part of the value of y: a reader decodes y
//       as it stands, the writer takes the nearest y that has the right lowest bit.
//
// Quantising what was decoded gives the same word again, except on the border of the octahedral square, where two
// codes are one direction.

namespace hearth::formats
{

/// Bits that VertexAttributes defines.
inline constexpr uint32_t kVertexAttributesAll = 127;

/// First word of attribute `bit` in a vertex that has `attributes`; `bit` is one of them. Positions are at 0.
constexpr uint32_t attributeWord(uint32_t attributes, uint32_t bit)
{
    return vertexWords(attributes & (bit - 1));
}

inline constexpr float kSnorm16Max = 32767.0f;
inline constexpr float kUnorm16Max = 65535.0f;

/// Nearest snorm16; values outside [-1, 1] are clamped.
inline int32_t quantizeSnorm16(float value)
{
    return static_cast<int32_t>(std::floor(std::clamp(value, -1.0f, 1.0f) * kSnorm16Max + 0.5f));
}

inline float dequantizeSnorm16(int32_t q)
{
    return std::max(static_cast<float>(q) / kSnorm16Max, -1.0f);
}

/// Nearest unorm16; values outside [0, 1] are clamped.
inline uint32_t quantizeUnorm16(float value)
{
    return static_cast<uint32_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * kUnorm16Max));
}

inline float dequantizeUnorm16(uint32_t q)
{
    return static_cast<float>(q) / kUnorm16Max;
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

/// The point of the square [-1, 1]^2 that stands for a direction of any length > 0.
inline Float2 octahedralFromDirection(Float3 d)
{
    const float sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    Float2 p{d.x / sum, d.y / sum};
    if (d.z < 0)
        p = {(1.0f - std::abs(p.y)) * (p.x < 0 ? -1.0f : 1.0f),
             (1.0f - std::abs(p.x)) * (p.y < 0 ? -1.0f : 1.0f)};
    return p;
}

inline Float3 directionFromOctahedral(Float2 p)
{
    Float3 d{p.x, p.y, 1.0f - std::abs(p.x) - std::abs(p.y)};
    if (d.z < 0)
    {
        d.x = (1.0f - std::abs(p.y)) * (p.x < 0 ? -1.0f : 1.0f);
        d.y = (1.0f - std::abs(p.x)) * (p.y < 0 ? -1.0f : 1.0f);
    }
    return d / length(d); // |d| >= 1/sqrt(3): never zero
}

/// `normal` finite and not zero; any length.
inline uint32_t encodeNormal(Float3 normal)
{
    const Float2 p = octahedralFromDirection(normal);
    return packHalves(quantizeSnorm16(p.x), quantizeSnorm16(p.y));
}

inline Float3 decodeNormal(uint32_t word)
{
    return directionFromOctahedral({dequantizeSnorm16(lowHalf(word)), dequantizeSnorm16(highHalf(word))});
}

/// xyz finite and not zero, w < 0 where the bitangent is flipped.
inline uint32_t encodeTangent(Float4 tangent)
{
    const Float2 p = octahedralFromDirection({tangent.x, tangent.y, tangent.z});
    const int32_t flipped = tangent.w < 0 ? 1 : 0;
    // y = 2k + flipped with the nearest k; -32767 is the least odd and -32766 the least even legal code
    const float k = std::floor((p.y * kSnorm16Max - static_cast<float>(flipped)) * 0.5f + 0.5f);
    const int32_t y = std::clamp(2 * static_cast<int32_t>(k) + flipped, -32766 - flipped, 32766 + flipped);
    return packHalves(quantizeSnorm16(p.x), y);
}

/// xyz unit, w = +1 or -1.
inline Float4 decodeTangent(uint32_t word)
{
    const Float3 direction = decodeNormal(word);
    return {direction.x, direction.y, direction.z, (word & 0x10000u) != 0 ? -1.0f : 1.0f};
}

/// Whether both halves are legal snorm16.
constexpr bool legalOctahedral(uint32_t word)
{
    return lowHalf(word) != -32768 && highHalf(word) != -32768;
}

struct ColorWords
{
    uint32_t word[2]; ///< red | green << 16, blue | alpha << 16
};

inline ColorWords encodeColor(Float4 color)
{
    return {{quantizeUnorm16(color.x) | quantizeUnorm16(color.y) << 16,
             quantizeUnorm16(color.z) | quantizeUnorm16(color.w) << 16}};
}

inline Float4 decodeColor(ColorWords words)
{
    return {dequantizeUnorm16(words.word[0] & 0xFFFFu), dequantizeUnorm16(words.word[0] >> 16),
            dequantizeUnorm16(words.word[1] & 0xFFFFu), dequantizeUnorm16(words.word[1] >> 16)};
}

/// Bytes of a cluster in its page: vertices, then three u8 indices for each triangle, padded with zeros to words.
constexpr uint32_t clusterBytes(uint32_t attributes, uint32_t vertex_count, uint32_t triangle_count)
{
    return 4 * (vertex_count * vertexWords(attributes) + (triangle_count * 3 + 3) / 4);
}

} // namespace hearth::formats
