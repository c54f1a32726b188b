// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/encoding/plain_image.h"

#include "formats/base/assert.h"
#include "formats/texels/decode_texels.h"

namespace hearth::texels
{

using namespace formats;

namespace
{

// Rows that are decoded at a time where a whole mip is read.
constexpr uint32_t kRowsAtOnce = 16;

} // namespace

std::span<const std::byte> mipBytes(const PlainImage& image, uint32_t mip)
{
    const auto first = static_cast<size_t>(mipOffset(image.record, mip));
    const auto end = static_cast<size_t>(mipOffset(image.record, mip + 1));
    return image.mips.subspan(first, end - first);
}

std::vector<DecodedTexel> decodeRows(const PlainImage& image, uint32_t mip, uint32_t first_row, uint32_t rows)
{
    const TexelFormatTraits& traits = *findTexelFormat(image.record.format);
    HEARTH_ASSERT(traits.family == TexelFamily::plain);
    const uint32_t width = mipExtent(image.record, mip).width;
    const size_t row_bytes = size_t{width} * traits.block_bytes;
    return decodeMip(traits, width, rows,
                     mipBytes(image, mip).subspan(first_row * row_bytes, rows * row_bytes));
}

Channels findConstantChannels(const PlainImage& image, DecodedTexel& values)
{
    Channels constant = kRgb | kAlpha;
    values = decodeRows(image, 0, 0, 1)[0];
    for (uint32_t mip = 0; mip < image.record.mip_count && constant != 0; ++mip)
    {
        const uint32_t height = mipExtent(image.record, mip).height;
        for (uint32_t y = 0; y < height && constant != 0; y += kRowsAtOnce)
            for (const DecodedTexel& texel : decodeRows(image, mip, y, std::min(kRowsAtOnce, height - y)))
                for (uint32_t c = 0; c < 4; ++c)
                    if (texel[c] != values[c])
                        constant &= static_cast<Channels>(~(1u << c));
    }
    return constant;
}

} // namespace hearth::texels
