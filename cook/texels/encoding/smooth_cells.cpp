// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/encoding/smooth_cells.h"

#include "cook/texels/encoding/texel_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace hearth::texels
{

using namespace formats;

namespace
{

constexpr uint64_t kMinSmoothPart = 2;                           // one of so many cells is smooth
constexpr int kMaxSmoothSpan = 4 * 257, kMaxSoftSpan = 48 * 257; // of 65535
constexpr uint32_t kMinEdgeCells = 3; // beside a cell; a spot, such as a star, hides nothing

/// Return the most that a channel that is read spans in a cell.
uint16_t findSpan(std::span<const DecodedTexel> texels, uint32_t width, Channels channels, uint64_t column)
{
    // one range for each texel of a row of the cell, so that processors take several at a time
    std::array<DecodedTexel, kCellSide> low, high;
    const uint64_t begin = column * kCellSide;
    for (uint64_t x = 0; x < kCellSide; ++x)
        low[x] = high[x] = texels[std::min<uint64_t>(begin + x, width - 1)];
    const uint64_t columns = std::min<uint64_t>(kCellSide, width - begin);
    for (size_t row = width; row < texels.size(); row += width)
        for (uint64_t x = 0; x < columns; ++x)
            for (uint32_t c = 0; c < 4; ++c)
            {
                const uint16_t value = texels[row + begin + x][c];
                low[x][c] = std::min(low[x][c], value);
                high[x][c] = std::max(high[x][c], value);
            }
    int span = 0;
    for (uint32_t c = 0; c < 4; ++c)
        if (has(channels, c))
            span = std::max(span, std::max({high[0][c], high[1][c], high[2][c], high[3][c]}) -
                                      std::min({low[0][c], low[1][c], low[2][c], low[3][c]}));
    return static_cast<uint16_t>(span);
}

/// Return the span of each cell of a mip.
std::vector<uint16_t> findSpans(const PlainImage& image, uint32_t mip, uint64_t columns, uint64_t rows)
{
    const MipExtent extent = mipExtent(image.record, mip);
    std::vector<uint16_t> spans(static_cast<size_t>(columns * rows));
    tbb::parallel_for(uint64_t{0}, rows,
                      [&](uint64_t row)
                      {
                          const auto y = static_cast<uint32_t>(row) * kCellSide;
                          const std::vector<DecodedTexel> texels =
                              decodeRows(image, mip, y, std::min(kCellSide, extent.height - y));
                          for (uint64_t column = 0; column < columns; ++column)
                              spans[row * columns + column] =
                                  findSpan(texels, extent.width, image.channels, column);
                      });
    return spans;
}

} // namespace

SmoothCells::SmoothCells(const PlainImage& image, uint32_t mip)
{
    const MipExtent extent = mipExtent(image.record, mip);
    width_ = extent.width;
    height_ = extent.height;
    columns_ = (uint64_t{extent.width} + kCellSide - 1) / kCellSide;
    const uint64_t rows = (uint64_t{extent.height} + kCellSide - 1) / kCellSide;
    const std::vector<uint16_t> spans = findSpans(image, mip, columns_, rows);
    is_smooth_.resize(spans.size());
    is_soft_.resize(spans.size());
    for (uint64_t row = 0; row < rows; ++row)
        for (uint64_t column = 0; column < columns_; ++column)
        {
            // the border repeats, so that an edge counts as much there
            uint32_t rough = 0;
            for (const uint64_t y : {row - std::min<uint64_t>(row, 1), row, std::min(row + 1, rows - 1)})
                for (const uint64_t x :
                     {column - std::min<uint64_t>(column, 1), column, std::min(column + 1, columns_ - 1)})
                    rough += spans[y * columns_ + x] > kMaxSmoothSpan ? 1u : 0u;
            const uint64_t cell = row * columns_ + column;
            is_smooth_[cell] = spans[cell] <= kMaxSmoothSpan && rough < kMinEdgeCells;
            is_soft_[cell] = spans[cell] <= kMaxSoftSpan;
        }
}

bool SmoothCells::showErrors(uint64_t x, uint64_t y, uint64_t width, uint64_t height) const
{
    const uint64_t right = std::min<uint64_t>(x + width, width_),
                   bottom = std::min<uint64_t>(y + height, height_);
    bool is_soft = true;
    for (uint64_t row = y / kCellSide; row * kCellSide < bottom; ++row)
        for (uint64_t column = x / kCellSide; column * kCellSide < right; ++column)
        {
            if (is_smooth_[row * columns_ + column] != 0)
                return true;
            is_soft = is_soft && is_soft_[row * columns_ + column] != 0;
        }
    return is_soft;
}

uint64_t SmoothCells::countSmooth() const
{
    return static_cast<uint64_t>(std::ranges::count(is_smooth_, uint8_t{1}));
}

uint64_t SmoothCells::countSmoothTexels() const
{
    uint64_t count = 0;
    for (uint64_t cell = 0; cell < is_smooth_.size(); ++cell)
        if (is_smooth_[cell] != 0)
            count += std::min<uint64_t>(kCellSide, width_ - cell % columns_ * kCellSide) *
                     std::min<uint64_t>(kCellSide, height_ - cell / columns_ * kCellSide);
    return count;
}

std::vector<SmoothCells> findSmoothCells(const PlainImage& image)
{
    std::vector<SmoothCells> mips;
    if (!isSrgb(image.record.format))
        return mips;
    for (uint32_t mip = 0; mip < countMeasuredMips(image.record); ++mip)
        mips.emplace_back(image, mip);
    uint64_t smooth = 0, all = 0;
    for (const SmoothCells& mip : mips)
    {
        smooth += mip.countSmooth();
        all += mip.count();
    }
    return smooth * kMinSmoothPart < all ? std::vector<SmoothCells>() : mips;
}

bool showsErrors(std::span<const SmoothCells> smooth, uint32_t mip, uint64_t x, uint64_t y,
                 const TexelFormatTraits& traits)
{
    return !smooth.empty() &&
           (mip >= smooth.size() || smooth[mip].showErrors(x, y, traits.block_width, traits.block_height));
}

} // namespace hearth::texels
