// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/decode_texels.h"

#include "formats/base/assert.h"
#include "formats/texels/astc_decoder.h"
#include "formats/texels/bc_decoder.h"
#include "formats/texels/etc2_decoder.h"
#include "formats/texels/plain_decoder.h"

#include <algorithm>
#include <array>

namespace hearth::formats
{

namespace
{

constexpr size_t kMaxBlockTexels = 12 * 12;

} // namespace

void decodeBlock(const TexelFormatTraits& traits, std::span<const std::byte> block,
                 std::span<DecodedTexel> texels)
{
    HEARTH_RUNTIME_ASSERT(block.size() == traits.block_bytes &&
                          texels.size() == size_t{traits.block_width} * traits.block_height);
    switch (traits.family)
    {
    case TexelFamily::plain:
        texels[0] = decodePlainTexel(traits.format, block);
        break;
    case TexelFamily::astc:
    case TexelFamily::astc_hdr:
        decodeAstcBlock(traits, block.first<16>(), texels);
        break;
    case TexelFamily::etc2:
        decodeEtc2Block(traits, block, texels.first<16>());
        break;
    case TexelFamily::bc:
        decodeBcBlock(traits, block, texels.first<16>());
        break;
    }
}

void decodeBlockRow(const TexelFormatTraits& traits, uint32_t width, uint32_t height,
                    std::span<const std::byte> row, std::span<DecodedTexel> texels)
{
    HEARTH_RUNTIME_ASSERT(row.size() == mipBytes(traits, width, 1) && height <= traits.block_height &&
                          texels.size() == size_t{width} * height);
    if (traits.family == TexelFamily::plain)
        return decodePlainRow(traits.format, row, texels);
    std::array<DecodedTexel, kMaxBlockTexels> block;
    for (uint32_t x = 0; x < width; x += traits.block_width)
    {
        const size_t column = x / traits.block_width;
        decodeBlock(traits, row.subspan(column * traits.block_bytes, traits.block_bytes),
                    std::span(block).first(size_t{traits.block_width} * traits.block_height));
        const uint32_t columns = std::min<uint32_t>(traits.block_width, width - x);
        for (uint32_t y = 0; y < height; ++y)
            std::copy_n(block.begin() + y * traits.block_width, columns,
                        texels.begin() + static_cast<ptrdiff_t>(size_t{y} * width + x));
    }
}

std::vector<DecodedTexel> decodeMip(const TexelFormatTraits& traits, uint32_t width, uint32_t height,
                                    std::span<const std::byte> mip)
{
    HEARTH_RUNTIME_ASSERT(mip.size() == mipBytes(traits, width, height));
    std::vector<DecodedTexel> texels(size_t{width} * height);
    const auto row_bytes = static_cast<size_t>(mipBytes(traits, width, 1));
    for (uint32_t y = 0; y < height; y += traits.block_height)
    {
        const uint32_t rows = std::min<uint32_t>(traits.block_height, height - y);
        decodeBlockRow(traits, width, rows, mip.subspan(y / traits.block_height * row_bytes, row_bytes),
                       std::span(texels).subspan(size_t{y} * width, size_t{rows} * width));
    }
    return texels;
}

} // namespace hearth::formats
