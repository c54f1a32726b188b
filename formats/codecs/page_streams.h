// Finds the streams of a geometry page's content (formats/codecs/page_codec.h), and checks their sizes
// against the page's records.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/codecs/page_codec.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace hearth::formats::page
{

inline constexpr size_t kClusterCorners = size_t{kMaxClusterTriangles} * 3;

/// Bytes after the content that decoding a cluster may overread: two for each corner, and a vector.
inline constexpr size_t kStreamSlack = 2 * kClusterCorners + 64;

inline constexpr size_t kMaxLaneBlocks = (kMaxLanes + kLanesPerBlock - 1) / kLanesPerBlock;
inline constexpr size_t kMaxLowBitPlanes = kLanesPerBlock * kMaxLowBitsAboveFour / 8;

struct Stream
{
    const uint8_t* at = nullptr;
    const uint8_t* end = nullptr;

    bool isOverrun() const { return at > end; }
    bool isAllRead() const { return at == end; }
};

struct Streams
{
    PageHeader header;
    LaneForms forms;
    Stream codes, uv_bases, wide, escapes;
    std::array<Stream, 2> restarts, reuses;
    std::array<const uint8_t*, 4> morphs{}; ///< planes of the words after triangles
    /// Low bytes; the high bytes follow header.references bytes later
    const uint8_t* references = nullptr;
    std::array<const uint8_t*, kMaxLanes> main{}, second{}; ///< bytes of lanes; nullptr: all bytes are 0
    std::array<std::array<const uint8_t*, kMaxLowBitPlanes>, kMaxLaneBlocks> low_bits{};
};

/// Sizes that the page's clusters require.
struct PageStreamSizes
{
    size_t codes = 0;
    size_t uv_base_bytes = 0;
    size_t wide_bytes = 0;
    size_t morph_words = 0; ///< words after the triangles of clusters
    size_t slots = 1;       ///< vertices of narrow clusters, plus one

    /// Add a cluster, and move `end` behind its triangles. False if the cluster begins before `end`, or is
    /// too large.
    bool add(const ClusterRecord& cluster, uint32_t mesh_layout, size_t& end);

    /// Add the words after the last cluster. False if the page ends before `end`.
    bool finish(size_t end, size_t page_size);
};

/// Split the content into streams. nullopt if the header is invalid, or the streams do not add up to the
/// content.
std::optional<Streams> splitContent(std::span<const std::byte> content, const PageStreamSizes& shape,
                                    const VertexLanes& lanes);

} // namespace hearth::formats::page
