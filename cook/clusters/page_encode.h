// Writes geometry pages in their stored form (formats/page_codec.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/coded_cluster.h"

#include <memory>
#include <span>
#include <vector>

namespace hearth::clusters
{

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

private:
    class State;
    std::unique_ptr<State> state_;
};

} // namespace hearth::clusters
