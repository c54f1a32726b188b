// Decodes texels that are not compressed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/texel_format.h"
#include "formats/texels/decoded_texel.h"

#include <cstddef>
#include <span>

namespace hearth::formats
{

/// Decode a texel of a format of family plain.
/// texel  block_bytes of the format
DecodedTexel decodePlainTexel(TexelFormat format, std::span<const std::byte> texel);

/// Decode a row of such texels.
/// row  of texels.size() texels
void decodePlainRow(TexelFormat format, std::span<const std::byte> row, std::span<DecodedTexel> texels);

} // namespace hearth::formats
