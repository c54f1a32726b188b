// Decodes BC7.
// Source: Khronos Data Format Specification 1.3, section 20.1.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/texels/decoded_texel.h"

#include <cstddef>
#include <span>

namespace hearth::formats
{

/// Decode a block of any 16 bytes to codes of 8 bits times 257. A reserved mode is 0, alpha too.
///
/// texels  4 x 4, rows from top to bottom
void decodeBc7Block(std::span<const std::byte, 16> block, std::span<DecodedTexel, 16> texels);

} // namespace hearth::formats
