// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/search/image_detail.h"

#include "cook/texels/encoding/texel_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace hearth::texels
{

using namespace formats;

namespace
{

// Parts of what is expected: all texels have the same, so that none is impossible; where smooth cells have a
// target of their own, what is expected of them is as large as of the others.
constexpr double kEvenPart = 0.2, kSmoothPart = 0.4;

/// Share of a block in each part, before it is divided by the sum.
struct BlockParts
{
    double texels = 0;
    double spread = 0; ///< variance times texels
    double smooth = 0; ///< variance times texels in smooth cells
};

/// Divide the parts by their sums, and weigh them.
std::vector<float> mixParts(std::span<const BlockParts> blocks)
{
    BlockParts sum;
    for (const BlockParts& block : blocks)
    {
        sum.texels += block.texels;
        sum.spread += block.spread;
        sum.smooth += block.smooth;
    }
    const double smooth = sum.smooth > 0 ? kSmoothPart / sum.smooth : 0;
    const double spread = sum.spread > 0 ? (1 - kEvenPart - smooth * sum.smooth) / sum.spread : 0;
    const double even = kEvenPart / sum.texels;
    std::vector<float> mixed;
    mixed.reserve(blocks.size());
    for (const BlockParts& block : blocks)
        mixed.push_back(
            static_cast<float>(block.texels * even + block.spread * spread + block.smooth * smooth));
    return mixed;
}

} // namespace

MipDetail::MipDetail(const PlainImage& image, uint32_t mip)
{
    const MipExtent extent = mipExtent(image.record, mip);
    width_ = extent.width;
    height_ = extent.height;
    columns_ = (size_t{width_} + kCellSide - 1) / kCellSide;
    const uint32_t rows = (height_ + kCellSide - 1) / kCellSide;
    cells_.resize(columns_ * rows);
    std::array<float, 4> scales{};
    for (uint32_t c = 0; c < 4; ++c)
        scales[c] = has(image.channels, c) ? 1 / 65535.0f : 0;
    const bool is_cutout = image.role == ImageRole::cutout;
    const auto weigh = [&](const DecodedTexel& texel)
    {
        std::array<float, 4> weighed{};
        const float alpha = is_cutout ? static_cast<float>(texel[3]) / 65535.0f : 1;
        for (uint32_t c = 0; c < 4; ++c)
            weighed[c] = static_cast<float>(texel[c]) * scales[c] * (c < 3 ? alpha : 1);
        return weighed;
    };
    tbb::parallel_for(uint32_t{0}, rows,
                      [&](uint32_t row)
                      {
                          const uint32_t height = std::min(kCellSide, height_ - row * kCellSide);
                          const std::vector<DecodedTexel> texels =
                              decodeRows(image, mip, row * kCellSide, height);
                          for (uint32_t left = 0; left < width_; left += kCellSide)
                          {
                              Cell cell;
                              for (uint32_t y = 0; y < height; ++y)
                                  for (uint32_t x = left; x < std::min(left + kCellSide, width_); ++x)
                                      cell.add(weigh(texels[size_t{y} * width_ + x]));
                              cells_[row * columns_ + left / kCellSide] = cell;
                          }
                      });
}

std::vector<float> MipDetail::expectErrors(uint32_t block_width, uint32_t block_height,
                                           const SmoothCells* smooth) const
{
    const uint32_t columns = (width_ + block_width - 1) / block_width;
    const uint32_t rows = (height_ + block_height - 1) / block_height;
    std::vector<BlockParts> blocks(size_t{columns} * rows);
    const auto addBlock = [&](uint32_t left, uint32_t top, BlockParts& block)
    {
        const uint32_t right = std::min(left + block_width, width_);
        const uint32_t bottom = std::min(top + block_height, height_);
        std::array<float, 4> values{}, squares{};
        double smooth_texels = 0;
        for (uint32_t y = top / kCellSide; y * kCellSide < bottom; ++y)
            for (uint32_t x = left / kCellSide; x * kCellSide < right; ++x)
            {
                // the block has the part of the cell that it covers
                const uint32_t cell_right = std::min(x * kCellSide + kCellSide, width_);
                const uint32_t cell_bottom = std::min(y * kCellSide + kCellSide, height_);
                const uint32_t covered = (std::min(right, cell_right) - std::max(left, x * kCellSide)) *
                                         (std::min(bottom, cell_bottom) - std::max(top, y * kCellSide));
                const uint32_t all = (cell_right - x * kCellSide) * (cell_bottom - y * kCellSide);
                const float part = static_cast<float>(covered) / static_cast<float>(all);
                const Cell& cell = cells_[y * columns_ + x];
                for (uint32_t c = 0; c < 4; ++c)
                {
                    values[c] += part * cell.values[c];
                    squares[c] += part * cell.squares[c];
                }
                if (smooth != nullptr && smooth->contains(x * kCellSide, y * kCellSide))
                    smooth_texels += covered;
            }
        block.texels = (right - left) * (bottom - top);
        for (uint32_t c = 0; c < 4; ++c)
            block.spread +=
                std::max(double{squares[c]} - double{values[c]} * double{values[c]} / block.texels, 0.0);
        block.smooth = block.spread * smooth_texels / block.texels;
    };
    tbb::parallel_for(uint32_t{0}, rows,
                      [&](uint32_t row)
                      {
                          for (uint32_t column = 0; column < columns; ++column)
                              addBlock(column * block_width, row * block_height,
                                       blocks[size_t{row} * columns + column]);
                      });
    return mixParts(blocks);
}

ImageDetail::ImageDetail(const PlainImage& image) : smooth(findSmoothCells(image))
{
    for (uint32_t mip = 0; mip < countMeasuredMips(image.record); ++mip)
        mips.emplace_back(image, mip);
}

} // namespace hearth::texels
