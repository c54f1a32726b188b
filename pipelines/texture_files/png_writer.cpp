// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/texture_files/png_writer.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <string_view>

namespace hearth::texture_files
{

namespace
{

using Codes = std::vector<uint8_t>;

void addBigEndian(Codes& file, uint32_t value)
{
    for (const int shift : {24, 16, 8, 0})
        file.push_back(static_cast<uint8_t>(value >> shift));
}

/// Return the cyclic redundancy check of PNG, bit by bit.
uint32_t checkCycle(std::span<const uint8_t> codes)
{
    uint32_t check = 0xFFFFFFFF;
    for (const uint8_t code : codes)
    {
        check ^= code;
        for (int bit = 0; bit < 8; ++bit)
            check = check >> 1 ^ ((check & 1) != 0 ? 0xEDB88320u : 0u);
    }
    return ~check;
}

void addChunk(Codes& file, std::string_view type, std::span<const uint8_t> content)
{
    addBigEndian(file, static_cast<uint32_t>(content.size()));
    const size_t start = file.size();
    file.insert(file.end(), type.begin(), type.end());
    file.insert(file.end(), content.begin(), content.end());
    addBigEndian(file, checkCycle(std::span(file).subspan(start)));
}

/// Wrap bytes as a zlib stream of stored blocks.
Codes storeBlocks(std::span<const uint8_t> codes)
{
    constexpr size_t kMaxBlock = 65535;
    Codes stream = {0x78, 0x01};
    uint32_t low = 1, high = 0; // Adler-32
    for (const uint8_t code : codes)
    {
        low = (low + code) % 65521;
        high = (high + low) % 65521;
    }
    for (size_t at = 0; at < codes.size(); at += kMaxBlock)
    {
        const auto block = codes.subspan(at, std::min(kMaxBlock, codes.size() - at));
        stream.push_back(at + block.size() == codes.size() ? 1 : 0);
        for (const size_t size : {block.size(), ~block.size()})
        {
            stream.push_back(static_cast<uint8_t>(size & 255));
            stream.push_back(static_cast<uint8_t>(size >> 8 & 255));
        }
        stream.insert(stream.end(), block.begin(), block.end());
    }
    addBigEndian(stream, high << 16 | low);
    return stream;
}

} // namespace

std::vector<std::byte> writePng(uint32_t width, uint32_t height, std::span<const uint8_t> codes)
{
    HEARTH_ASSERT(width > 0 && height > 0 && codes.size() == size_t{3} * width * height);
    Codes header;
    addBigEndian(header, width);
    addBigEndian(header, height);
    header.insert(header.end(), {8, 2, 0, 0, 0}); // bits, red-green-blue, deflate, filters, no interlace
    Codes rows;
    for (uint32_t y = 0; y < height; ++y)
    {
        rows.push_back(0); // no filter
        const auto row = codes.subspan(size_t{3} * width * y, size_t{3} * width);
        rows.insert(rows.end(), row.begin(), row.end());
    }
    Codes file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    addChunk(file, "IHDR", header);
    addChunk(file, "IDAT", storeBlocks(rows));
    addChunk(file, "IEND", {});
    const auto bytes = std::as_bytes(std::span(file));
    return {bytes.begin(), bytes.end()};
}

} // namespace hearth::texture_files
