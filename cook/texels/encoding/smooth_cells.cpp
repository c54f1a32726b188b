// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/encoding/smooth_cells.h"

#include "cook/texels/encoding/texel_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <utility>

namespace hearth::texels
{

using namespace formats;

namespace
{

constexpr uint64_t kMinSmoothPart = 2; // one of so many cells is smooth
constexpr int kMaxSpan = 4 * 257;      // of 65535
constexpr uint32_t kMinEdgeCells = 3;  // beside a cell; a spot, such as a star, hides nothing

/// Return whether no channel that is read spans more than kMaxSpan in a cell.
bool isFlat(std::span<const DecodedTexel> texels, uint32_t width, Channels channels, uint64_t column)
{
    // one range for each texel of a row of the cell: four times as fast as one for the cell
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
    for (uint32_t c = 0; c < 4; ++c)
    {
        const auto [lowest, highest] = std::pair{std::min({low[0][c], low[1][c], low[2][c], low[3][c]}),
                                                 std::max({high[0][c], high[1][c], high[2][c], high[3][c]})};
        if (has(channels, c) && highest - lowest > kMaxSpan)
            return false;
    }
    return true;
}

/// Return, for each cell of a mip, whether it is flat.
std::vector<uint8_t> findFlatCells(const PlainImage& image, uint32_t mip, uint64_t columns, uint64_t rows)
{
    const MipExtent extent = mipExtent(image.record, mip);
    std::vector<uint8_t> is_flat(static_cast<size_t>(columns * rows));
    tbb::parallel_for(uint64_t{0}, rows,
                      [&](uint64_t row)
                      {
                          const auto y = static_cast<uint32_t>(row) * kCellSide;
                          const std::vector<DecodedTexel> texels =
                              decodeRows(image, mip, y, std::min(kCellSide, extent.height - y));
                          for (uint64_t column = 0; column < columns; ++column)
                              is_flat[row * columns + column] =
                                  isFlat(texels, extent.width, image.channels, column);
                      });
    return is_flat;
}

} // namespace

SmoothCells::SmoothCells(const PlainImage& image, uint32_t mip)
{
    const MipExtent extent = mipExtent(image.record, mip);
    width_ = extent.width;
    height_ = extent.height;
    columns_ = (uint64_t{extent.width} + kCellSide - 1) / kCellSide;
    const uint64_t rows = (uint64_t{extent.height} + kCellSide - 1) / kCellSide;
    const std::vector<uint8_t> is_flat = findFlatCells(image, mip, columns_, rows);
    is_smooth_.resize(is_flat.size());
    for (uint64_t row = 0; row < rows; ++row)
        for (uint64_t column = 0; column < columns_; ++column)
        {
            // the border repeats, so that an edge counts as much there
            uint32_t rough = 0;
            for (const uint64_t y : {row - std::min<uint64_t>(row, 1), row, std::min(row + 1, rows - 1)})
                for (const uint64_t x :
                     {column - std::min<uint64_t>(column, 1), column, std::min(column + 1, columns_ - 1)})
                    rough += is_flat[y * columns_ + x] == 0 ? 1u : 0u;
            is_smooth_[row * columns_ + column] =
                is_flat[row * columns_ + column] != 0 && rough < kMinEdgeCells;
        }
}

bool SmoothCells::touch(uint64_t x, uint64_t y, uint64_t width, uint64_t height) const
{
    const uint64_t right = std::min<uint64_t>(x + width, width_),
                   bottom = std::min<uint64_t>(y + height, height_);
    for (uint64_t row = y / kCellSide; row * kCellSide < bottom; ++row)
        for (uint64_t column = x / kCellSide; column * kCellSide < right; ++column)
            if (is_smooth_[row * columns_ + column] != 0)
                return true;
    return false;
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

bool hasSmoothCells(std::span<const SmoothCells> smooth, uint32_t mip, uint64_t x, uint64_t y,
                    const TexelFormatTraits& traits)
{
    return !smooth.empty() &&
           (mip >= smooth.size() || smooth[mip].touch(x, y, traits.block_width, traits.block_height));
}

} // namespace hearth::texels
