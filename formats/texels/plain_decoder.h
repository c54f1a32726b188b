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

} // namespace hearth::formats
