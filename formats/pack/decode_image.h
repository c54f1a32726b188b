// Decodes a mip of a pack's image.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"
#include "formats/texels/decoded_texel.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::formats
{

/// Decode a mip as it is stored, before the image's swizzle.
///
/// mips  all of the image, as PackView::imageData returns them
/// mip   0 to image.mip_count - 1
/// returns  texels of mipExtent(image, mip), rows from top to bottom
std::vector<DecodedTexel> decodeImageMip(const ImageRecord& image, std::span<const std::byte> mips,
                                         uint32_t mip);

} // namespace hearth::formats
