// Decodes ASTC, two-dimensional, LDR and HDR profile.
// Source: Khronos Data Format Specification 1.4, chapter "ASTC Compressed Texture Image Formats".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/texel_format.h"
#include "formats/texels/decoded_texel.h"

#include <cstddef>
#include <span>

namespace hearth::formats
{

/// Decode a block of any 16 bytes. Blocks that the specification calls illegal, and HDR void extents in a
/// format of unorm or sRGB, get its error colour: magenta, or NaN in floats. HDR endpoints in a format of
/// unorm or sRGB are magenta in their partition alone. Alpha in a format of sRGB has 8 bits, as the colours
/// have: version 1.4 takes back what 1.3 says of it.
///
/// traits  family astc or astc_hdr
/// texels  block_width * block_height, rows from top to bottom
void decodeAstcBlock(const TexelFormatTraits& traits, std::span<const std::byte, 16> block,
                     std::span<DecodedTexel> texels);

} // namespace hearth::formats
