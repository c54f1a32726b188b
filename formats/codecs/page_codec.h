// Defines the stored form of a geometry page (PageCodec::clusters) for its writer and reader. See FORMAT.md,
// "Geometry pages".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/codecs/vertex_codec.h"
#include "formats/records/fields.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hearth::formats
{

/// Prediction of a lane. The vertices of a narrow cluster are split into lanes of 16 bits (halves of words),
/// each predicted from earlier vertices.
enum class LaneKind : uint8_t
{
    /// 16 bits, predicted from the point that completes the edge and the third corner to a parallelogram
    grid,
    word,  ///< 16 bits, predicted from the edge's second vertex
    bytes, ///< two numbers of 8 bits, predicted from the edge's second vertex
};

/// Maximum number of lanes: kHeaderLanes for a vertex with all attributes (the largest layout), and the
/// influences of a skin on top.
inline constexpr uint32_t kHeaderLanes = 30;
inline constexpr uint32_t kMaxLanes = kHeaderLanes + 16;

struct VertexLanes
{
    std::array<LaneKind, kMaxLanes> kinds{};
    uint32_t count = 0;
};

/// Return the lanes of a narrow cluster's vertices, in memory order.
constexpr VertexLanes vertexLanes(uint32_t layout)
{
    VertexLanes lanes;
    const auto add = [&](LaneKind kind, uint32_t count)
    {
        for (uint32_t i = 0; i < count; ++i)
            lanes.kinds[lanes.count++] = kind;
    };
    add(LaneKind::grid, 3);
    add(LaneKind::bytes, 1);
    if ((layout & kVertexNormal) && (layout & kVertexNormal16))
        add(LaneKind::word, 2);
    if (layout & kVertexTangent)
        add((layout & kVertexNormal16) ? LaneKind::word : LaneKind::bytes, 2);
    for (uint32_t set = 0; set < 4; ++set)
        if (layout & kVertexUv0 << set)
            uvFractionBits(layout, set) == 0 ? add(LaneKind::word, 4) : add(LaneKind::grid, 2);
    if (layout & kVertexColor)
        (layout & kVertexColor16) ? add(LaneKind::word, 4) : add(LaneKind::bytes, 2);
    if (layout & kVertexVisibility)
        add(LaneKind::bytes, 2);
    add(LaneKind::word, 2 * influencesPerVertex(layout));
    return lanes;
}

/// True if the lane is a number whose word has another number in its other half: their main bits share bytes.
constexpr bool sharesMainByte(const VertexLanes& lanes, size_t lane)
{
    return lanes.kinds[lane] != LaneKind::bytes && lanes.kinds[lane ^ 1] != LaneKind::bytes;
}

/// Header of a page's content. The streams follow, in this order:
///     codes        for each cluster, 4 bits a triangle except the first, low bits first, padded to a byte
///     restarts     a byte for the first triangle of each cluster and for each with code kCodeRestart: first
///                  of the clusters at even indices in the page, then of the clusters at odd indices
///     reuses       a byte for each corner that is a vertex of the same cluster, in the order of restarts
///     references   two planes (low bytes, high bytes) of numbers: vertices equal to one of an earlier
///                  cluster
///     uv_bases     the words before the clusters' vertices
///     wide         the vertices of wide clusters, uncompressed
///     more_lanes   if a vertex has more than kHeaderLanes lanes: planes and low_bits of the others, as in
///                  the header, kMaxLanes - kHeaderLanes bytes each
///     morphs       the words after the clusters' triangles, in four planes: the first bytes of all words,
///                  then the second bytes, and so on
///     escapes      two bytes for each number of a new vertex whose main bits are all set: the number. Sorted
///                  by groups of sixteen vertices, then by lane, then by vertex
///     planes       one byte of each new vertex: the main bytes of numbers, then of lanes of two bytes; the
///                  second bytes of lanes of two bytes; then for each block of eight lanes the bytes of its
///                  low bits
/// A lane of 16 bits is a number (zigzag16). Its low bits are in the field of its block, where the fields of
/// the block's lanes follow each other. The bits above are its main byte. If both halves of a word are
/// numbers, the four main bits of the second number are stored above the four of the first in the first
/// number's main byte.
/// A lane of two bytes is its main byte and its second byte, or (kPlaneNibbles) the upper halves of both,
/// then the lower.
struct PageHeader
{
    uint16_t restarts[2];
    uint16_t reuses[2];
    uint16_t references;
    uint16_t new_vertices;
    uint32_t escapes;
    uint8_t planes[kHeaderLanes];
    uint8_t low_bits[kHeaderLanes];
};

/// Storage of the numbers of each lane.
struct LaneForms
{
    std::array<uint8_t, kMaxLanes> planes{};   ///< as PageHeader::planes
    std::array<uint8_t, kMaxLanes> low_bits{}; ///< as PageHeader::low_bits
};

/// Return the size in bytes of stream more_lanes.
constexpr size_t moreLaneBytes(const VertexLanes& lanes)
{
    return lanes.count > kHeaderLanes ? 2 * size_t{kMaxLanes - kHeaderLanes} : 0;
}

/// Read the storage of all lanes.
/// more_lanes  moreLaneBytes bytes
inline LaneForms readLaneForms(const PageHeader& header, std::span<const std::byte> more_lanes)
{
    LaneForms forms;
    std::copy_n(header.planes, kHeaderLanes, forms.planes.begin());
    std::copy_n(header.low_bits, kHeaderLanes, forms.low_bits.begin());
    for (size_t i = 0; i < more_lanes.size() / 2; ++i)
    {
        forms.planes[kHeaderLanes + i] = std::to_integer<uint8_t>(more_lanes[i]);
        forms.low_bits[kHeaderLanes + i] = std::to_integer<uint8_t>(more_lanes[more_lanes.size() / 2 + i]);
    }
    return forms;
}

inline constexpr uint32_t kEscape = 255;
inline constexpr uint32_t kEscapeOfFourBits = 15; ///< for shared main bytes

inline constexpr uint8_t kPlaneMain = 1; ///< bits of LaneForms::planes: bytes of an absent plane are 0
inline constexpr uint8_t kPlaneSecond = 2;
inline constexpr uint8_t kPlaneNibbles = 4; ///< for a lane of two bytes
inline constexpr uint32_t kLanesPerBlock = 8;

/// Maximum number of bits below main bytes, and below four main bits.
inline constexpr uint32_t kMaxLowBits = 8;
inline constexpr uint32_t kMaxLowBitsAboveFour = 12;

/// Bit positions of the low bits of a block's lanes.
struct LowBitFields
{
    std::array<uint32_t, kLanesPerBlock> first{};
    uint32_t bits = 0; ///< of all lanes
    uint32_t planes() const { return (bits + 7) / 8; }
};

constexpr LowBitFields lowBitFields(const LaneForms& forms, size_t block)
{
    LowBitFields fields;
    for (size_t i = 0; i < kLanesPerBlock && block * kLanesPerBlock + i < kMaxLanes; ++i)
    {
        fields.first[i] = fields.bits;
        fields.bits += forms.low_bits[block * kLanesPerBlock + i];
    }
    return fields;
}

// Codes of triangles. Triangles follow each other along shared edges. A triangle (a, b, c) has the edge (c,
// b) to its right and (a, c) to its left. The next triangle starts with one of these two edges, or with an
// edge on the stack, and adds a corner. code = 3 * edge + corner
inline constexpr uint32_t kEdgeRight = 0;
inline constexpr uint32_t kEdgeRightPushLeft = 1; ///< and push the left edge on the stack
inline constexpr uint32_t kEdgeLeft = 2;
inline constexpr uint32_t kEdgePopped = 3; ///< pop the edge from the stack
inline constexpr uint32_t kCornerNew = 0;
/// New in this cluster, but equal to a vertex of an earlier cluster
inline constexpr uint32_t kCornerReference = 1;
inline constexpr uint32_t kCornerReuse = 2;
/// Three corners: bits 0..1, 2..3 and 4..5 of a byte of restarts
inline constexpr uint32_t kCodeRestart = 15;

/// Return the number of codes of a cluster: none for its first triangle, which is a restart.
constexpr uint32_t codeCount(uint32_t triangle_count)
{
    return triangle_count == 0 ? 0 : triangle_count - 1;
}
constexpr size_t codeBytes(uint32_t triangle_count)
{
    return (codeCount(triangle_count) + size_t{1}) / 2;
}

/// Map small numbers of either sign to small unsigned numbers.
constexpr uint16_t zigzag16(uint16_t value)
{
    return static_cast<uint16_t>(value << 1 ^ (value & 0x8000 ? 0xFFFF : 0));
}
constexpr uint16_t unzigzag16(uint16_t value)
{
    return static_cast<uint16_t>(value >> 1 ^ (value & 1 ? 0xFFFF : 0));
}
} // namespace hearth::formats

HEARTH_RECORD(hearth::formats::PageHeader, 76,
              HEARTH_FIELD(hearth::formats::PageHeader, restarts,
                           "bytes of stream restarts: of clusters at even places, of those at odd places"),
              HEARTH_FIELD(hearth::formats::PageHeader, reuses, "bytes of stream reuses, the same"),
              HEARTH_FIELD(hearth::formats::PageHeader, references, "numbers in stream references"),
              HEARTH_FIELD(hearth::formats::PageHeader, new_vertices, "bytes of each plane"),
              HEARTH_FIELD(hearth::formats::PageHeader, escapes, "numbers in stream escapes"),
              HEARTH_FIELD(hearth::formats::PageHeader, planes,
                           "of each lane: bit 0 main bytes, bit 1 second bytes, 0 where all are 0; bit 2 "
                           "bytes are cut in halves"),
              HEARTH_FIELD(hearth::formats::PageHeader, low_bits,
                           "of each lane of 16 bits: how many are below the main ones, 0 to 8, or to 12"));
