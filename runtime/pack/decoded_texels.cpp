// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/decoded_texels.h"

#include "formats/texels/decode_texels.h"
#include "formats/texels/plain_encoder.h"

namespace hearth::pack
{

using formats::TexelFormat;
using formats::TexelFormatTraits;

namespace
{

const TexelFormatTraits& decodedTraits(const formats::ImageRecord& image)
{
    return formats::texelTraits(decodedFormat(*formats::findTexelFormat(image.format)));
}

/// Return the rows of a mip that a piece has.
uint32_t pieceRows(const formats::ImageRecord& image, const formats::TexturePiece& piece, uint32_t mip)
{
    return mip == piece.mip ? piece.rows : formats::mipExtent(image, mip).height;
}

} // namespace

TexelFormat decodedFormat(const TexelFormatTraits& traits)
{
    if (traits.coding == formats::TexelCoding::float_value)
        return TexelFormat::rgba16_float;
    if (traits.coding == formats::TexelCoding::srgb)
        return TexelFormat::rgba8_srgb;
    return traits.channels == 1   ? TexelFormat::r8_unorm
           : traits.channels == 2 ? TexelFormat::rg8_unorm
                                  : TexelFormat::rgba8_unorm;
}

size_t decodedBytes(const formats::ImageRecord& image, const formats::TexturePiece& piece)
{
    size_t texels = 0;
    for (uint32_t mip = piece.mip; mip < piece.mip + piece.mip_count; ++mip)
        texels += size_t{formats::mipExtent(image, mip).width} * pieceRows(image, piece, mip);
    return texels * decodedTraits(image).block_bytes;
}

void decodeTexels(const formats::ImageRecord& image, const formats::TexturePiece& piece,
                  std::span<const std::byte> stored, std::span<std::byte> texels)
{
    const TexelFormatTraits& from = *formats::findTexelFormat(image.format);
    const TexelFormatTraits& to = decodedTraits(image);
    for (uint32_t mip = piece.mip; mip < piece.mip + piece.mip_count; ++mip)
    {
        const uint32_t width = formats::mipExtent(image, mip).width, rows = pieceRows(image, piece, mip);
        const auto bytes = static_cast<size_t>(formats::mipBytes(from, width, rows));
        const std::vector<formats::DecodedTexel> decoded =
            formats::decodeMip(from, width, rows, stored.first(bytes));
        const std::span<std::byte> out = texels.first(decoded.size() * to.block_bytes);
        formats::encodePlain(to, decoded, out);
        stored = stored.subspan(bytes);
        texels = texels.subspan(out.size());
    }
}

std::vector<std::byte> decodeTexels(const formats::ImageRecord& image, std::span<const std::byte> stored)
{
    const formats::TexturePiece all{
        .mip = 0, .mip_count = image.mip_count, .first_row = 0, .rows = image.height, .offset = 0, .size = 0};
    std::vector<std::byte> texels(decodedBytes(image, all));
    decodeTexels(image, all, stored, texels);
    return texels;
}

} // namespace hearth::pack
