// Weights of an ASTC block: its block mode, the stored grid, and the weight of each texel.
// Source: Khronos Data Format Specification, sections "Block Mode" and "Weight Decoding" to "Weight Infill".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/texels/astc_integers.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace hearth::formats
{

inline constexpr size_t kMaxAstcBlockTexels = 12 * 12;

/// Grid of weights that a block mode describes.
struct AstcGrid
{
    uint32_t width, height;
    uint32_t planes; ///< weights a position: 1 or 2
    size_t range;    ///< of kAstcRanges
    size_t bits;     ///< of all weights, 24 to 96: the last bits of the block
};

/// Read the block mode: the lowest 11 bits of a block that is no void extent. Nothing if it is reserved or
/// its grid is illegal for the footprint.
std::optional<AstcGrid> readAstcGrid(uint32_t block_mode, uint32_t block_width, uint32_t block_height);

/// Decode the weight of each texel: 0 to 64, by plane. The second plane is untouched where there is one.
/// weights  [plane][block_width * block_height], rows from top to bottom
void decodeAstcWeights(const AstcBits& block, const AstcGrid& grid, uint32_t block_width,
                       uint32_t block_height,
                       std::array<std::array<uint8_t, kMaxAstcBlockTexels>, 2>& weights);

} // namespace hearth::formats
