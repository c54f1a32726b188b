// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/decode_image.h"

#include "formats/pack/pack_view.h"
#include "formats/texels/decode_texels.h"

namespace hearth::formats
{

std::vector<DecodedTexel> decodeImageMip(const ImageRecord& image, std::span<const std::byte> mips,
                                         uint32_t mip)
{
    const TexelFormatTraits& traits = *findTexelFormat(image.format);
    const MipExtent extent = mipExtent(image, mip);
    const auto first = static_cast<size_t>(mipOffset(image, mip));
    const auto size = static_cast<size_t>(mipBytes(traits, extent.width, extent.height));
    return decodeMip(traits, extent.width, extent.height, mips.subspan(first, size));
}

} // namespace hearth::formats
