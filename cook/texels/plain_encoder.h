// Encodes texels in formats without compression.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/texel_format.h"
#include "formats/texels/decoded_texel.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hearth::texels
{

/// Encode texels in a format of family plain: 8 bits to the nearest, or RGB9E5, to the nearest.
std::vector<std::byte> encodePlain(const formats::TexelFormatTraits& traits,
                                   std::span<const formats::DecodedTexel> texels);

} // namespace hearth::texels
