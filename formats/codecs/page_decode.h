// Decodes geometry pages from their stored form into what the GPU reads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/mesh.h"

#include <cstddef>
#include <memory>
#include <span>

namespace hearth::formats
{

/// Memory that decoding needs, kept from page to page. One for each thread that decodes.
class PageDecoder
{
public:
    PageDecoder();
    PageDecoder(PageDecoder&&) noexcept;
    PageDecoder& operator=(PageDecoder&&) noexcept;
    ~PageDecoder();

    /// Decode a page of PageCodec::clusters. Safe for any bytes and any records: false where they do not fit each
    /// other, and then nothing is said about what `out` holds. Writes nothing beside `out`.
    ///
    /// clusters     of the page, in order; their data fills the page without gaps
    /// mesh_layout  MeshRecord::attributes, legal
    bool decode(std::span<const std::byte> stored, std::span<const ClusterRecord> clusters,
                uint32_t mesh_layout, std::span<std::byte> out);

private:
    struct Scratch;
    std::unique_ptr<Scratch> scratch_;
};

} // namespace hearth::formats
