// Encodes geometry pages to their stored form (formats/codecs/page_codec.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/mesh.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace hearth::pages
{

/// Geometry of a cluster, decoded, as in formats/records/mesh.h for one cluster at its page_word.
struct CodedCluster
{
    std::vector<uint32_t> words;  ///< UV bases, then vertices
    std::vector<uint8_t> indices; ///< three for each triangle
    std::vector<uint32_t> morphs; ///< morph section; empty in a mesh without targets
};

/// Encodes pages; reuses its memory from page to page. The result does not depend on earlier pages.
class PageEncoder
{
public:
    PageEncoder();
    PageEncoder(PageEncoder&&) noexcept;
    PageEncoder& operator=(PageEncoder&&) noexcept;
    ~PageEncoder();

    /// Return the page's stored bytes. Reorders the triangles and vertices of `clusters` to the order in the
    /// page. Time linear in the page's size.
    ///
    /// records      of the clusters: base, extent_shift and counts are read
    /// mesh_layout  MeshRecord::attributes
    std::vector<std::byte> encode(std::span<const formats::ClusterRecord> records, uint32_t mesh_layout,
                                  std::span<CodedCluster> clusters);

    /// Encode a decoded page again after values in its vertices have changed; triangles and vertices keep
    /// their order. If nothing has changed, the stored bytes are those that encode() made.
    ///
    /// clusters  their vertices are in the order of their first use
    /// codes     stream codes of the stored page (formats/codecs/page_codec.h)
    std::vector<std::byte> encodeAgain(std::span<const formats::ClusterRecord> records, uint32_t mesh_layout,
                                       std::span<CodedCluster> clusters, std::span<const uint8_t> codes);

private:
    class State;
    std::unique_ptr<State> state_;
};

} // namespace hearth::pages
