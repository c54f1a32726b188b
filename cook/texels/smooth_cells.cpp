// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/smooth_cells.h"

#include "cook/texels/texel_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace hearth::texels
{

using namespace formats;

namespace
{

constexpr uint32_t kSide = 4;
constexpr uint64_t kMinSmoothPart = 2; // one of so many cells is smooth
constexpr int kMaxSpan = 4 * 257;      // of 65535

} // namespace

SmoothCells::SmoothCells(const PlainImage& image, uint32_t mip)
{
    const MipExtent extent = mipExtent(image.record, mip);
    columns_ = (uint64_t{extent.width} + kSide - 1) / kSide;
    const uint64_t rows = (uint64_t{extent.height} + kSide - 1) / kSide;
    is_smooth_.resize(static_cast<size_t>(columns_ * rows));
    tbb::parallel_for(uint64_t{0}, rows,
                      [&](uint64_t row)
                      {
                          const auto y = static_cast<uint32_t>(row) * kSide;
                          const uint32_t height = std::min(kSide, extent.height - y);
                          const std::vector<DecodedTexel> texels = decodeRows(image, mip, y, height);
                          for (uint64_t column = 0; column < columns_; ++column)
                          {
                              int span = 0;
                              for (uint32_t c = 0; c < 4; ++c)
                              {
                                  int low = 65535, high = 0;
                                  for (uint32_t j = 0; j < height; ++j)
                                      for (uint64_t x = column * kSide;
                                           x < std::min<uint64_t>(column * kSide + kSide, extent.width); ++x)
                                      {
                                          const int value = texels[j * extent.width + x][c];
                                          low = std::min(low, value);
                                          high = std::max(high, value);
                                      }
                                  span = has(image.channels, c) ? std::max(span, high - low) : span;
                              }
                              is_smooth_[row * columns_ + column] = span <= kMaxSpan;
                          }
                      });
}

uint64_t SmoothCells::countSmooth() const
{
    return static_cast<uint64_t>(std::ranges::count(is_smooth_, uint8_t{1}));
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

} // namespace hearth::texels
