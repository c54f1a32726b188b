// What is left of a page's new vertices, as planes of bytes: how many bits of each lane are worth a code.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/codecs/page_codec.h"
#include "formats/codecs/vector16.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::pages
{

inline constexpr size_t kMostBlocks = (formats::kMaxLanes + formats::kHalves - 1) / formats::kHalves;

/// The lanes of a vertex in whole vectors.
using VertexRow = std::array<formats::Halves, kMostBlocks>;

/// The planes of one page after the other.
class PagePlanes
{
public:
    /// Begin a page.
    void clear(const formats::VertexLanes& lanes);

    /// The residuals of a new vertex: numbers as formats::zigzag16 has them.
    void add(const VertexRow& residuals) { rows_.push_back(residuals); }

    /// All vertices are there: choose the forms of their lanes and make the planes. Fills new_vertices and escapes of the
    /// header.
    formats::LaneForms make(formats::PageHeader& header);

    /// In the order in which they stand in the page.
    std::span<const std::vector<uint8_t>> planes() const { return {planes_.data(), plane_count_}; }

    std::span<const uint8_t> escapes() const { return escapes_; }

private:
    void spreadLanes();
    void chooseLowBits(size_t block, formats::LaneForms& forms) const;
    uint32_t escapeOf(size_t lane) const;
    void addNumberPlanes(formats::LaneForms& forms);
    void addBytePlanes(formats::LaneForms& forms);
    void addLowBits(size_t block, const formats::LaneForms& forms);
    void collectEscapes(const formats::LaneForms& forms);
    std::vector<uint8_t>& nextPlane();
    bool dropZeros();

    formats::VertexLanes lanes_;
    std::vector<VertexRow> rows_;
    std::array<std::vector<uint16_t>, kMostBlocks * formats::kHalves> values_; ///< of each lane
    std::vector<std::vector<uint8_t>> planes_; ///< the first plane_count_ are in use
    size_t plane_count_ = 0;
    std::vector<uint8_t> escapes_;
};

} // namespace hearth::pages
