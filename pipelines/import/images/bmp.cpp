// Decodes Windows bitmaps: 1, 4, 8, 16, 24 and 32 bits, palettes and bit fields, both row orders; run-length
// coding is not supported. Written from Microsoft's description of BITMAPFILEHEADER, BITMAPINFOHEADER, V4 and
// V5.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/byte_reader.h"
#include "pipelines/import/images/codecs.h"

#include <array>
#include <bit>
#include <cstdlib>

namespace hearth::import
{

namespace
{

constexpr uint32_t kBitFields = 3;
constexpr uint32_t kAlphaBitFields = 6;
constexpr uint32_t kFileHeaderBytes = 14;
constexpr uint32_t kInfoHeaderBytes = 40;

struct BmpHeader
{
    uint32_t data_offset = 0;
    uint32_t header_bytes = 0;
    int64_t width = 0;
    int64_t height = 0; ///< negative: rows from top to bottom
    uint32_t depth = 0;
    uint32_t compression = 0;
    uint32_t palette_size = 0;
    std::array<uint32_t, 4> masks{};
};

/// Return the bits of `mask` in `word`, scaled to 0..255.
uint8_t field(uint32_t word, uint32_t mask)
{
    const auto shift = static_cast<uint32_t>(std::countr_zero(mask));
    const uint64_t largest = mask >> shift;
    const uint64_t value = (word & mask) >> shift;
    return static_cast<uint8_t>((value * 255u + largest / 2u) / largest);
}

/// Read the masks of the bit fields from the file, or use the conventional masks if it has none.
bool readMasks(ByteReader& reader, BmpHeader& header)
{
    if (header.compression == kBitFields || header.compression == kAlphaBitFields)
    {
        const bool with_alpha = header.compression == kAlphaBitFields || header.header_bytes >= 56;
        for (size_t i = 0; i < (with_alpha ? 4u : 3u); ++i)
        {
            const auto mask = reader.read<uint32_t>();
            if (!mask || (i < 3 && *mask == 0))
                return false;
            header.masks[i] = *mask;
        }
    }
    else if (header.depth == 16)
        header.masks = {0x7C00u, 0x03E0u, 0x001Fu, 0};
    else
        header.masks = {0xFF0000u, 0xFF00u, 0xFFu, 0};
    return true;
}

std::optional<BmpHeader> readHeader(ByteReader& reader)
{
    BmpHeader header;
    reader.seek(10);
    const auto data_offset = reader.read<uint32_t>();
    const auto header_bytes = reader.read<uint32_t>();
    const auto width = reader.read<int32_t>();
    const auto height = reader.read<int32_t>();
    const auto planes = reader.read<uint16_t>();
    const auto depth = reader.read<uint16_t>();
    const auto compression = reader.read<uint32_t>();
    const bool rest = reader.skip(12);
    const auto palette_size = reader.read<uint32_t>();
    if (!palette_size || !reader.skip(4) || !rest || *header_bytes < kInfoHeaderBytes || *planes != 1)
        return std::nullopt;
    header = {*data_offset, *header_bytes, *width, *height, *depth, *compression, *palette_size, {}};
    return header;
}

std::optional<std::vector<std::array<uint8_t, 4>>> readPalette(ByteReader& reader, const BmpHeader& header)
{
    const uint32_t largest = 1u << header.depth;
    const uint32_t size = header.palette_size == 0 ? largest : header.palette_size;
    if (size > largest || !reader.seek(uint64_t{kFileHeaderBytes} + header.header_bytes))
        return std::nullopt;
    std::vector<std::array<uint8_t, 4>> palette(size);
    for (auto& color : palette)
    {
        const auto entry = reader.read<std::array<uint8_t, 4>>();
        if (!entry)
            return std::nullopt;
        color = {(*entry)[2], (*entry)[1], (*entry)[0], 255};
    }
    return palette;
}

uint32_t storedValue(const uint8_t* row, uint32_t x, uint32_t depth)
{
    if (depth < 8)
    {
        const uint32_t per_byte = 8u / depth;
        return (uint32_t{row[x / per_byte]} >> (8u - depth * (x % per_byte + 1u))) & ((1u << depth) - 1u);
    }
    uint32_t value = 0;
    for (uint32_t i = 0; i < depth / 8; ++i)
        value |= static_cast<uint32_t>(row[x * (depth / 8) + i]) << (8 * i);
    return value;
}

} // namespace

Result<DecodedImage> decodeBmp(const EncodedImage& source)
{
    ByteReader reader(source.bytes);
    auto header = readHeader(reader);
    if (!header)
        return source.malformed("BMP: the header is damaged");
    const uint32_t depth = header->depth;
    if (header->compression != 0 && header->compression != kBitFields &&
        header->compression != kAlphaBitFields)
        return source.unsupported("compressed BMP images are not read");
    if (depth != 1 && depth != 4 && depth != 8 && depth != 16 && depth != 24 && depth != 32)
        return source.malformed("BMP: " + std::to_string(depth) + " bits for a texel");
    if (header->width <= 0)
        return source.malformed("BMP: the width is " + std::to_string(header->width));
    const auto width = static_cast<uint64_t>(header->width);
    const auto height = static_cast<uint64_t>(std::abs(header->height));
    HEARTH_TRY(checkImageSize(source, width, height));

    std::vector<std::array<uint8_t, 4>> palette;
    if (depth <= 8)
    {
        auto read = readPalette(reader, *header);
        if (!read)
            return source.malformed("BMP: the palette is damaged");
        palette = std::move(*read);
    }
    else if (!readMasks(reader, *header))
        return source.malformed("BMP: the bit fields are damaged");

    const uint64_t row_bytes = (width * depth + 31u) / 32u * 4u;
    const auto rows = checkedPart(source.bytes, header->data_offset, height, row_bytes);
    if (!rows)
        return source.malformed("BMP: the file ends too early");

    HEARTH_ASSIGN_OR_RETURN(DecodedImage image, allocateImage(source, width, height, ChannelType::unorm8));
    uint8_t* texel = imageBytes(image);
    for (uint64_t y = 0; y < height; ++y)
    {
        const auto* row = reinterpret_cast<const uint8_t*>(rows->data()) +
                          row_bytes * (header->height < 0 ? y : height - 1 - y);
        for (uint32_t x = 0; x < image.width; ++x, texel += 4)
        {
            const uint32_t value = storedValue(row, x, depth);
            if (depth <= 8 && value >= palette.size())
                return source.malformed("BMP: an index lies outside the palette");
            if (depth <= 8)
                std::copy(palette[value].begin(), palette[value].end(), texel);
            else
                for (size_t c = 0; c < 4; ++c)
                    texel[c] = header->masks[c] == 0 ? uint8_t{255} : field(value, header->masks[c]);
        }
    }
    return image;
}

} // namespace hearth::import
