// Decodes geometry pages from their stored form into the form that the GPU reads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/mesh.h"

#include <cstddef>
#include <memory>
#include <span>

namespace hearth::formats
{

/// Decoder of pages. It keeps its memory from page to page; use one for each thread.
class PageDecoder
{
public:
    PageDecoder();
    PageDecoder(PageDecoder&&) noexcept;
    PageDecoder& operator=(PageDecoder&&) noexcept;
    ~PageDecoder();

    /// Decode a page of PageCodec::clusters. Safe for any bytes and any records: returns false if they do not
    /// match; the content of `out` is then undefined. Writes nothing outside `out`.
    ///
    /// clusters     clusters of the page, in order; their data fills the page without gaps
    /// mesh_layout  MeshRecord::attributes, legal
    bool decode(std::span<const std::byte> stored, std::span<const ClusterRecord> clusters,
                uint32_t mesh_layout, std::span<std::byte> out);

private:
    struct Scratch;
    std::unique_ptr<Scratch> scratch_;
};

} // namespace hearth::formats
