// Pieces of an image: its texels in units that are read and decoded one by one, so that mips can be streamed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <cstdint>
#include <vector>

namespace hearth::formats
{

/// Sides of mips that share the last piece, the tail: they are always resident, and 64 KiB hold them in any
/// format.
inline constexpr uint32_t kMaxTailSide = 64;

/// Bytes of a piece, unless one row of blocks takes more.
inline constexpr uint32_t kMaxPieceBytes = 1 << 16;

/// Rows of blocks of one mip, or all mips of the tail.
struct TexturePiece
{
    uint32_t mip;
    uint32_t mip_count; ///< 1, but for the tail
    uint32_t first_row; ///< texels; a multiple of the block's height
    uint32_t rows;      ///< texels; of the tail: all of `mip`
    uint64_t offset;    ///< in the image's texels, all mips
    uint32_t size;      ///< bytes
};

/// Return the first mip of the tail: that of which no side is longer than kMaxTailSide, or the last.
uint32_t firstTailMip(const ImageRecord& image);

/// Return the pieces in the order of the texels; they cover all mips.
/// image  a size, a format and mips that exist
std::vector<TexturePiece> listTexturePieces(const ImageRecord& image);

} // namespace hearth::formats
