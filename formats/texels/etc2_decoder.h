// Decodes ETC2 and EAC.
// Source: Khronos Data Format Specification 1.3, chapters 21 and 22.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/texel_format.h"
#include "formats/texels/decoded_texel.h"

#include <cstddef>
#include <span>

namespace hearth::formats
{

/// Decode a block of any bytes.
///
/// traits  family etc2
/// block   traits.block_bytes
/// texels  4 x 4, rows from top to bottom
void decodeEtc2Block(const TexelFormatTraits& traits, std::span<const std::byte> block,
                     std::span<DecodedTexel, 16> texels);

} // namespace hearth::formats
