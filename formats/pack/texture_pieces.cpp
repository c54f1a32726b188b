// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/texture_pieces.h"

#include <algorithm>

namespace hearth::formats
{

uint32_t firstTailMip(const ImageRecord& image)
{
    uint32_t mip = 0;
    while (mip + 1 < image.mip_count &&
           std::max(mipExtent(image, mip).width, mipExtent(image, mip).height) > kMaxTailSide)
        ++mip;
    return mip;
}

std::vector<TexturePiece> listTexturePieces(const ImageRecord& image)
{
    const TexelFormatTraits& traits = *findTexelFormat(image.format);
    const uint32_t tail = firstTailMip(image);
    std::vector<TexturePiece> pieces;
    uint64_t offset = 0;
    for (uint32_t mip = 0; mip < tail; ++mip)
    {
        const MipExtent extent = mipExtent(image, mip);
        const uint64_t row_bytes = mipBytes(traits, extent.width, 1);
        const auto band =
            static_cast<uint32_t>(std::max<uint64_t>(kMaxPieceBytes / row_bytes, 1)) * traits.block_height;
        for (uint32_t row = 0; row < extent.height; row += band)
        {
            const uint32_t rows = std::min(band, extent.height - row);
            const auto size = static_cast<uint32_t>(mipBytes(traits, extent.width, rows));
            pieces.push_back({mip, 1, row, rows, offset, size});
            offset += size;
        }
    }
    const auto size = static_cast<uint32_t>(mipOffset(image, image.mip_count) - offset);
    pieces.push_back({tail, image.mip_count - tail, 0, mipExtent(image, tail).height, offset, size});
    return pieces;
}

} // namespace hearth::formats
