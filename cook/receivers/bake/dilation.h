// Continues the texels of a rectangle beyond the rims of its charts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::receivers
{

/// Texels by which charts are continued, so that bilinear taps within a chart read its own values.
inline constexpr uint32_t kDilation = 2;

struct TexelCell
{
    int32_t x, y; ///< in the rectangle; its border has -1 and the size
};

/// Copy of a texel beside it.
struct TexelCopy
{
    TexelCell cell;
    uint32_t source; ///< index of a texel
};

/// Return copies for the cells of a rectangle and its border that are at most kDilation cells from a texel,
/// each of a texel that is nearest by that count, by rows. A cell beside prefers its edges' neighbours to its
/// corners'.
/// texels  within the rectangle
std::vector<TexelCopy> dilate(uint32_t width, uint32_t height, std::span<const TexelCell> texels);

} // namespace hearth::receivers
