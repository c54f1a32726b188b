// The streams of a geometry page's content (formats/codecs/page_codec.h), found and measured against the page's records.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/codecs/page_codec.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace hearth::formats::page
{

inline constexpr size_t kClusterCorners = size_t{kClusterMaxTriangles} * 3;

/// Bytes behind the content that a cluster may read in vain: two for each corner, and a vector.
inline constexpr size_t kStreamSlack = 2 * kClusterCorners + 64;

inline constexpr size_t kMostBlocks = (kMaxLanes + kLanesOfBlock - 1) / kLanesOfBlock;
inline constexpr size_t kMostLowPlanes = kLanesOfBlock * kMaxLowBitsOfFour / 8;

struct Stream
{
    const uint8_t* at = nullptr;
    const uint8_t* end = nullptr;

    bool overrun() const { return at > end; }
    bool allRead() const { return at == end; }
};

struct Streams
{
    PageHeader header;
    LaneForms forms;
    Stream codes, uv_bases, wide, escapes;
    std::array<Stream, 2> restarts, reuses;
    std::array<const uint8_t*, 4> morphs{}; ///< the planes of the words behind triangles
    const uint8_t* references = nullptr;    ///< low bytes; the high ones header.references behind them
    std::array<const uint8_t*, kMaxLanes> main{}, second{}; ///< bytes of lanes; nullptr: all are 0
    std::array<std::array<const uint8_t*, kMostLowPlanes>, kMostBlocks> low_bits{};
};

/// What the page's clusters need.
struct PageShape
{
    size_t codes = 0;
    size_t uv_base_bytes = 0;
    size_t wide_bytes = 0;
    size_t morph_words = 0; ///< behind the triangles of clusters
    size_t slots = 1;       ///< vertices of narrow clusters, and one

    /// False where the cluster begins before `end`, which is moved behind its triangles, or is too large.
    bool add(const ClusterRecord& cluster, uint32_t mesh_layout, size_t& end);

    /// What stands behind the last cluster. False where the page ends before `end`.
    bool finish(size_t end, size_t page_size);
};

/// nullopt where the header says what is not legal, or the streams are not as long as the content.
std::optional<Streams> splitContent(std::span<const std::byte> content, const PageShape& shape,
                                    const VertexLanes& lanes);

} // namespace hearth::formats::page
