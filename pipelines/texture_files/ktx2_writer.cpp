// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/texture_files/ktx2_writer.h"

#include "formats/base/assert.h"
#include "pipelines/texture_files/data_format.h"

#include <zstd.h>

#include <algorithm>
#include <numeric>
#include <string_view>

namespace hearth::texture_files
{

using namespace formats;

namespace
{

constexpr std::string_view kIdentifier("\xABKTX 20\xBB\r\n\x1A\n", 12);
constexpr uint32_t kSchemeNone = 0, kSchemeZstd = 2;
constexpr size_t kHeaderBytes = 80, kLevelIndexBytes = 24;

/// Level for files that are written once; as packs have it.
constexpr int kZstdLevel = 19;

struct Level
{
    std::vector<std::byte> compressed; ///< empty: `bytes` are stored
    std::span<const std::byte> bytes;
    uint64_t offset = 0;

    std::span<const std::byte> stored() const { return compressed.empty() ? bytes : compressed; }
};

void append(std::vector<std::byte>& file, uint64_t number, size_t size)
{
    for (size_t i = 0; i < size; ++i)
        file.push_back(static_cast<std::byte>(number >> (8 * i)));
}

void pad(std::vector<std::byte>& file, size_t alignment)
{
    file.resize((file.size() + alignment - 1) / alignment * alignment);
}

/// Append an entry of key and value; the value is a text that ends in 0.
void appendText(std::vector<std::byte>& entries, std::string_view key, std::string_view value)
{
    append(entries, key.size() + value.size() + 2, 4);
    for (const std::string_view text : {key, value})
    {
        const auto bytes = std::as_bytes(std::span(text));
        entries.insert(entries.end(), bytes.begin(), bytes.end());
        entries.push_back({});
    }
    pad(entries, 4);
}

/// Return the entries, sorted by their keys.
std::vector<std::byte> writeEntries(const Texture& texture, const std::string& writer)
{
    std::vector<std::byte> entries;
    appendText(entries, "KTXorientation", "rd");
    if (texture.swizzle != "rgba")
        appendText(entries, "KTXswizzle", texture.swizzle);
    appendText(entries, "KTXwriter", writer);
    return entries;
}

std::vector<std::byte> compress(std::span<const std::byte> bytes)
{
    std::vector<std::byte> frame(ZSTD_compressBound(bytes.size()));
    const size_t size = ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), kZstdLevel);
    HEARTH_ASSERT(ZSTD_isError(size) == 0);
    frame.resize(size);
    return frame;
}

/// Return the levels, finest first, without their places.
std::vector<Level> splitLevels(const Texture& texture, bool compressed)
{
    std::vector<Level> levels(texture.mip_count);
    uint64_t offset = 0;
    for (uint32_t i = 0; i < texture.mip_count; ++i)
    {
        const uint64_t size =
            mipBytes(*texture.traits, std::max(1u, texture.width >> i), std::max(1u, texture.height >> i));
        HEARTH_ASSERT(size <= texture.mips.size() - offset);
        levels[i].bytes = texture.mips.subspan(static_cast<size_t>(offset), static_cast<size_t>(size));
        if (compressed)
            levels[i].compressed = compress(levels[i].bytes);
        offset += size;
    }
    HEARTH_ASSERT(offset == texture.mips.size());
    return levels;
}

/// Give each level its place: the coarsest first. Return the size of the file.
uint64_t placeLevels(std::vector<Level>& levels, uint64_t end, uint64_t alignment)
{
    for (auto level = levels.rbegin(); level != levels.rend(); ++level)
    {
        level->offset = (end + alignment - 1) / alignment * alignment;
        end = level->offset + level->stored().size();
    }
    return end;
}

} // namespace

std::vector<std::byte> writeKtx2(const Texture& texture, const std::string& writer, bool compressed)
{
    const TexelFormatTraits& traits = *texture.traits;
    HEARTH_ASSERT(traits.vulkan_format != 0 && texture.width > 0 && texture.height > 0 &&
                  texture.mip_count > 0);
    const std::vector<uint32_t> descriptor = describeTexels(traits);
    const std::vector<std::byte> entries = writeEntries(texture, writer);
    const uint64_t descriptor_offset = kHeaderBytes + kLevelIndexBytes * texture.mip_count;
    const uint64_t entries_offset = descriptor_offset + descriptor.size() * sizeof(uint32_t);

    std::vector<Level> levels = splitLevels(texture, compressed);
    const uint64_t alignment = compressed ? 1 : std::lcm<uint64_t>(traits.block_bytes, 4);
    const uint64_t size = placeLevels(levels, entries_offset + entries.size(), alignment);

    std::vector<std::byte> file;
    file.reserve(static_cast<size_t>(size));
    const auto identifier = std::as_bytes(std::span(kIdentifier));
    file.assign(identifier.begin(), identifier.end());
    const uint32_t scheme = compressed ? kSchemeZstd : kSchemeNone;
    for (const uint32_t number : {traits.vulkan_format, typeBytes(traits), texture.width, texture.height, 0u,
                                  0u, 1u, texture.mip_count, scheme}) // no depth, no layers, one face
        append(file, number, 4);
    append(file, descriptor_offset, 4);
    append(file, descriptor.size() * sizeof(uint32_t), 4);
    append(file, entries_offset, 4);
    append(file, entries.size(), 4);
    append(file, 0, 8); // no global data: neither offset nor size
    append(file, 0, 8);
    for (const Level& level : levels)
    {
        append(file, level.offset, 8);
        append(file, level.stored().size(), 8);
        append(file, level.bytes.size(), 8);
    }
    for (const uint32_t word : descriptor)
        append(file, word, 4);
    file.insert(file.end(), entries.begin(), entries.end());
    for (auto level = levels.rbegin(); level != levels.rend(); ++level)
    {
        file.resize(static_cast<size_t>(level->offset));
        file.insert(file.end(), level->stored().begin(), level->stored().end());
    }
    return file;
}

} // namespace hearth::texture_files
