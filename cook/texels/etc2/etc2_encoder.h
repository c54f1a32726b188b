// Encodes blocks of colours as ETC2: RGB8, and RGBA8 with EAC's alpha.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/blocks/block_texels.h"
#include "cook/texels/etc2/search_tables.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace hearth::texels
{

/// Block of ETC2's RGB8, or the part of RGBA8 with the colours.
struct EncodedColors
{
    std::array<std::byte, 8> bytes;
    uint32_t error; ///< sum of weighted squares of differences, in codes of 8 bits
};

/// Block of RGBA8.
struct EncodedRgba
{
    std::array<std::byte, 16> bytes;
    uint32_t color_error; ///< as in EncodedColors
    uint32_t alpha_error; ///< sum of squares
};

/// Encoder of blocks, each by itself: the same bytes in any order and on any thread. All computation is on
/// integers.
class Etc2Encoder
{
public:
    /// weights  of red, green and blue in the error, each 1 to kMaxWeight
    explicit Etc2Encoder(Effort effort, ColorWeights weights = {1, 1, 1});

    /// Encode the colours of a block; its alpha is not read.
    EncodedColors encodeRgb(const Block8& block) const;
    /// Encode colours and alpha, each by itself.
    EncodedRgba encodeRgba(const Block8& block) const;

private:
    Effort effort_;
    SearchTables tables_;
};

} // namespace hearth::texels
