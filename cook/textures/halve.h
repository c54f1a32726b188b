// Shrinks an image with an exact box filter: each texel of the result is the mean of the area that it covers.
// A box has no ringing, keeps the energy, and needs nothing beyond the image's edge, so that the wrap mode of
// the texture does not matter. Odd sizes give fractional weights and lose no row or column.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hearth::textures
{

struct FloatImage
{
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<Float4> texels; ///< rows from top to bottom

    std::span<const Float4> row(uint32_t y) const
    {
        return std::span(texels).subspan(size_t{y} * width, width);
    }
    std::span<Float4> row(uint32_t y) { return std::span(texels).subspan(size_t{y} * width, width); }
};

/// Fills a row of the source image; called from several threads.
using RowReader = std::function<void(uint32_t y, std::span<Float4> out)>;

/// Return an image of another size, of at least one texel. Same result for any number of threads.
FloatImage averageAreas(uint32_t width, uint32_t height, const RowReader& readRow, uint32_t target_width,
                        uint32_t target_height);

/// Return the image of half the size, max(1, size / 2) on each side. Same result for any number of threads.
FloatImage halve(uint32_t width, uint32_t height, const RowReader& readRow);

} // namespace hearth::textures
