// Decodes ASTC with libastcenc, to judge what Hearth's own decoder says.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/texel_format.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::texels::test
{

/// Decode a mip in a format of LDR or sRGB to channels from 0 to 1, sRGB as codes.
std::vector<float> decodeByAstcenc(const formats::TexelFormatTraits& traits, uint32_t width, uint32_t height,
                                   std::span<const std::byte> mip);

} // namespace hearth::texels::test
