// Writes geometry pages in their stored form (formats/codecs/page_codec.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/mesh.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace hearth::pages
{

/// Geometry of a cluster, decoded: what formats/records/mesh.h says of a page, one cluster at its page_word.
struct CodedCluster
{
    std::vector<uint32_t> words;  ///< UV bases, then vertices
    std::vector<uint8_t> indices; ///< three for each triangle
    std::vector<uint32_t> morphs; ///< the morph section; empty in a mesh without targets
};

/// Memory that encoding needs, kept from page to page. What it makes does not depend on the pages before.
class PageEncoder
{
public:
    PageEncoder();
    PageEncoder(PageEncoder&&) noexcept;
    PageEncoder& operator=(PageEncoder&&) noexcept;
    ~PageEncoder();

    /// The page's stored bytes. The triangles and vertices of `clusters` are put in the order that the page has them in.
    /// Time linear in the page's size.
    ///
    /// records      of the clusters: base, extent_shift and counts are looked at
    /// mesh_layout  MeshRecord::attributes
    std::vector<std::byte> encode(std::span<const formats::ClusterRecord> records, uint32_t mesh_layout,
                                  std::span<CodedCluster> clusters);

    /// The same of what a page was decoded to, after values in its vertices have changed: triangles and vertices stay where
    /// they are. Where nothing has changed, the stored bytes are those that encode() made.
    ///
    /// clusters  their vertices stand in the order of their first use
    /// codes     stream codes of the stored page (formats/codecs/page_codec.h)
    std::vector<std::byte> encodeAgain(std::span<const formats::ClusterRecord> records, uint32_t mesh_layout,
                                       std::span<CodedCluster> clusters, std::span<const uint8_t> codes);

private:
    class State;
    std::unique_ptr<State> state_;
};

} // namespace hearth::pages
