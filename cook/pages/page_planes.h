// Splits the residuals of a page's new vertices into planes of bytes, and chooses the number of entropy-coded
// bits of each lane.
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

inline constexpr size_t kMaxRowBlocks = (formats::kMaxLanes + formats::kHalves - 1) / formats::kHalves;

/// Lanes of a vertex in whole vectors.
using VertexRow = std::array<formats::Halves, kMaxRowBlocks>;

/// Builds the planes of one page after the other.
class PagePlanes
{
public:
    /// Begin a page.
    void clear(const formats::VertexLanes& lanes);

    /// Add the residuals of a new vertex: numbers in the code of formats::zigzag16.
    void add(const VertexRow& residuals) { rows_.push_back(residuals); }

    /// Choose the forms of the lanes and build the planes, after all vertices were added. Sets new_vertices
    /// and escapes of the header.
    formats::LaneForms make(formats::PageHeader& header);

    /// Return the planes in the order of the page.
    std::span<const std::vector<uint8_t>> planes() const { return {planes_.data(), plane_count_}; }

    std::span<const uint8_t> escapes() const { return escapes_; }

private:
    void spreadLanes();
    void chooseLowBits(size_t block, formats::LaneForms& forms) const;
    uint32_t escapeCode(size_t lane) const;
    void addNumberPlanes(formats::LaneForms& forms);
    void addBytePlanes(formats::LaneForms& forms);
    void addLowBits(size_t block, const formats::LaneForms& forms);
    void collectEscapes(const formats::LaneForms& forms);
    std::vector<uint8_t>& nextPlane();
    bool dropZeros();

    formats::VertexLanes lanes_;
    std::vector<VertexRow> rows_;
    std::array<std::vector<uint16_t>, kMaxRowBlocks * formats::kHalves> values_; ///< for each lane
    std::vector<std::vector<uint8_t>> planes_; ///< the first plane_count_ are in use
    size_t plane_count_ = 0;
    std::vector<uint8_t> escapes_;
};

} // namespace hearth::pages
