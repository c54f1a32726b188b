// Decodes stored texels of every format.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/texel_format.h"
#include "formats/texels/decoded_texel.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::formats
{

/// Decode one block of a format: one texel, unless it is compressed.
///
/// block   traits.block_bytes
/// texels  traits.block_width * traits.block_height, rows from top to bottom
void decodeBlock(const TexelFormatTraits& traits, std::span<const std::byte> block,
                 std::span<DecodedTexel> texels);

/// Decode a row of blocks.
///
/// width   texels of the mip
/// height  texel rows that are wanted, from the first of the row of blocks: 1 to traits.block_height
/// row     mipBytes(traits, width, 1)
/// texels  width * height, rows from top to bottom
void decodeBlockRow(const TexelFormatTraits& traits, uint32_t width, uint32_t height,
                    std::span<const std::byte> row, std::span<DecodedTexel> texels);

/// Decode a mip.
///
/// mip  mipBytes(traits, width, height)
/// returns  width * height texels, rows from top to bottom
std::vector<DecodedTexel> decodeMip(const TexelFormatTraits& traits, uint32_t width, uint32_t height,
                                    std::span<const std::byte> mip);

} // namespace hearth::formats
