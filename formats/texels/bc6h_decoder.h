// Decodes BC6H.
// Source: Khronos Data Format Specification 1.3, section 20.2.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/texels/decoded_texel.h"

#include <cstddef>
#include <span>

namespace hearth::formats
{

/// Decode a block of any 16 bytes to half floats. A reserved mode is black. Signed blocks may hold -infinity.
///
/// texels  4 x 4, rows from top to bottom
void decodeBc6hBlock(bool is_signed, std::span<const std::byte, 16> block,
                     std::span<DecodedTexel, 16> texels);

} // namespace hearth::formats
