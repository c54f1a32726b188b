// Encodes texels in formats without compression.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/texel_format.h"
#include "formats/texels/decoded_texel.h"

#include <cstddef>
#include <span>

namespace hearth::formats
{

/// Encode texels in a format of family plain: numbers of 8 bits to the nearest, RGB9E5 to the nearest, and
/// channels of 16 bits as they are.
/// bytes  filled: traits.block_bytes for each texel (asserted)
void encodePlain(const TexelFormatTraits& traits, std::span<const DecodedTexel> texels,
                 std::span<std::byte> bytes);

} // namespace hearth::formats
