// Finds the smooth areas of an image, where the eye sees errors that it would not see elsewhere: seams
// between blocks, steps in a gradient.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/plain_image.h"

#include <cstdint>
#include <vector>

namespace hearth::texels
{

/// Texels of a side of a cell.
inline constexpr uint32_t kCellSide = 4;

/// Cells of 4 x 4 texels of a mip, from its corner on. A cell is smooth if no channel that is read spans more
/// than 4 of 255 codes in it, and if fewer than three of the eight cells around it span more: an edge hides
/// errors beside it, a spot does not.
class SmoothCells
{
public:
    SmoothCells(const PlainImage& image, uint32_t mip);

    /// True if the texel lies in a smooth cell.
    bool contains(uint64_t x, uint64_t y) const
    {
        return is_smooth_[y / kCellSide * columns_ + x / kCellSide] != 0;
    }

    /// True if errors are seen in a rectangle within the mip: it has a smooth cell, or no cell with an edge,
    /// which spans more than 48 of 255 codes. Seams show in a soft cloud, although its cells are not smooth.
    bool showErrors(uint64_t x, uint64_t y, uint64_t width, uint64_t height) const;

    uint64_t countSmooth() const;
    uint64_t count() const { return is_smooth_.size(); }
    /// Return the number of texels in smooth cells.
    uint64_t countSmoothTexels() const;

private:
    uint32_t width_, height_; ///< of the mip
    uint64_t columns_;
    std::vector<uint8_t> is_smooth_; ///< [row of cells * columns_ + column]
    std::vector<uint8_t> is_soft_;   ///< the same: no edge in it
};

/// Return the cells of the mips that errors are measured on; none unless the image is a colour and half of
/// its cells are smooth: a sky, a glow, a panel. Elsewhere texture hides what smooth areas would show.
std::vector<SmoothCells> findSmoothCells(const PlainImage& image);

/// Return whether errors of a block are seen: where there are smooth cells, as SmoothCells::showErrors; in
/// mips coarser than those of smooth, of all.
/// smooth  as findSmoothCells
/// x, y    the block's first texel
bool showsErrors(std::span<const SmoothCells> smooth, uint32_t mip, uint64_t x, uint64_t y,
                 const formats::TexelFormatTraits& traits);

} // namespace hearth::texels
