// Tells how much the texels of each block vary, from which its error is expected before it is encoded.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/smooth_cells.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hearth::texels
{

/// Sums over the cells of 4 x 4 texels of a mip.
class MipDetail
{
public:
    MipDetail(const PlainImage& image, uint32_t mip);

    /// Return what is expected of the error of each block of a size, in rows from the top. It grows with the
    /// variance of the block's texels, of which a mip has a sum of .8; each texel adds to the rest.
    /// smooth  cells whose error counts on its own: blocks with them have half of the .8; or null
    std::vector<float> expectErrors(uint32_t block_width, uint32_t block_height,
                                    const SmoothCells* smooth) const;

private:
    /// Sums of the channels that are read.
    struct Cell
    {
        /// texel  its channels that are read, as their errors count; others are 0
        void add(const std::array<float, 4>& texel)
        {
            for (uint32_t c = 0; c < 4; ++c)
            {
                values[c] += texel[c];
                squares[c] += texel[c] * texel[c];
            }
        }

        std::array<float, 4> values{};
        std::array<float, 4> squares{};
    };

    uint32_t width_, height_; ///< of the mip
    size_t columns_;
    std::vector<Cell> cells_; ///< [row of cells * columns_ + column]
};

/// Detail of the mips that errors are measured on.
struct ImageDetail
{
    explicit ImageDetail(const PlainImage& image);

    std::vector<MipDetail> mips{};
    std::vector<SmoothCells> smooth{}; ///< as findSmoothCells
};

} // namespace hearth::texels
