// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/container_image.h"

#include "formats/base/byte_reader.h"
#include "formats/container/container_reader.h"
#include "formats/records/chunk_list.h"
#include "formats/records/mesh.h"

#include <zstd.h>

#include <cstring>
#include <memory>

namespace hearth::test
{

using namespace formats;

namespace
{

size_t alignUp(size_t position)
{
    return (position + kChunkAlignment - 1) / kChunkAlignment * kChunkAlignment;
}

std::span<std::byte> writable(std::span<std::byte> bytes, uint64_t offset, uint64_t size)
{
    const bool fits = offset <= bytes.size() && size <= bytes.size() - offset;
    return fits ? bytes.subspan(static_cast<size_t>(offset), static_cast<size_t>(size))
                : std::span<std::byte>();
}

template <typename T>
T readAs(std::span<const std::byte> bytes)
{
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
}

/// Return the bytes of every entry of the chunk table, if the table lies inside the file.
std::vector<std::span<std::byte>> tableEntries(std::span<std::byte> bytes)
{
    if (bytes.size() < sizeof(FileHeader))
        return {};
    const auto header = readAs<FileHeader>(bytes);
    std::vector<std::span<std::byte>> entries;
    for (uint64_t i = 0; i < header.chunk_count; ++i)
    {
        const std::span<std::byte> entry =
            header.table_offset > bytes.size()
                ? std::span<std::byte>()
                : writable(bytes, header.table_offset + i * sizeof(ChunkEntry), sizeof(ChunkEntry));
        if (entry.empty())
            break;
        entries.push_back(entry);
    }
    return entries;
}

} // namespace

AlignedBytes::AlignedBytes(std::span<const std::byte> bytes)
    : blocks_((bytes.size() + kChunkAlignment - 1) / kChunkAlignment), size_(bytes.size())
{
    if (!bytes.empty())
        std::memcpy(blocks_.data(), bytes.data(), bytes.size());
}

AlignedBytes& AlignedBytes::operator=(AlignedBytes other) noexcept
{
    blocks_.swap(other.blocks_);
    size_ = other.size_;
    return *this;
}

ChunkImage plainChunk(uint32_t type, uint32_t index, uint32_t element_size, std::span<const std::byte> bytes)
{
    ChunkImage chunk;
    chunk.entry.type = type;
    chunk.entry.index = index;
    chunk.entry.version = chunkVersion(type);
    chunk.entry.element_size = element_size;
    chunk.entry.size = bytes.size();
    chunk.stored.assign(bytes.begin(), bytes.end());
    return chunk;
}

ChunkImage zstdChunk(uint32_t type, uint32_t index, uint32_t element_size, std::span<const std::byte> bytes)
{
    ChunkImage chunk = plainChunk(type, index, element_size, bytes);
    chunk.entry.codec = static_cast<uint32_t>(Codec::zstd);
    chunk.stored.resize(ZSTD_compressBound(bytes.size()));
    chunk.stored.resize(
        ZSTD_compress(chunk.stored.data(), chunk.stored.size(), bytes.data(), bytes.size(), 1));
    return chunk;
}

ChunkImage framesChunk(uint32_t type, uint32_t index, std::span<const std::byte> bytes,
                       std::span<const uint32_t> sizes)
{
    ChunkImage chunk = plainChunk(type, index, 1, bytes);
    chunk.entry.codec = static_cast<uint32_t>(Codec::zstd_frames);
    chunk.stored.clear();
    for (const uint32_t size : sizes)
    {
        const ChunkImage frame = zstdChunk(type, index, 1, bytes.first(size));
        chunk.stored.insert(chunk.stored.end(), frame.stored.begin(), frame.stored.end());
        bytes = bytes.subspan(size);
    }
    return chunk;
}

ChunkImage streamedChunk(uint32_t type, uint32_t index, uint32_t element_size,
                         std::span<const std::byte> bytes)
{
    ChunkImage chunk = zstdChunk(type, index, element_size, bytes);
    chunk.stored.resize(ZSTD_compressBound(bytes.size()));
    const std::unique_ptr<ZSTD_CCtx, size_t (*)(ZSTD_CCtx*)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_contentSizeFlag, 0);
    chunk.stored.resize(
        ZSTD_compress2(context.get(), chunk.stored.data(), chunk.stored.size(), bytes.data(), bytes.size()));
    return chunk;
}

AlignedBytes assemble(ContainerKind kind, std::span<const ChunkImage> chunks)
{
    std::vector<std::byte> bytes(sizeof(FileHeader));
    std::vector<ChunkEntry> table;
    for (const ChunkImage& chunk : chunks)
    {
        bytes.resize(alignUp(bytes.size()));
        ChunkEntry entry = chunk.entry;
        entry.offset = bytes.size();
        entry.stored_size = chunk.stored.size();
        entry.hash = hashBytes(chunk.stored);
        table.push_back(entry);
        bytes.insert(bytes.end(), chunk.stored.begin(), chunk.stored.end());
    }
    bytes.resize(alignUp(bytes.size()));

    FileHeader header{};
    std::memcpy(header.magic, kMagic, sizeof(kMagic));
    header.version_major = kVersionMajor;
    header.version_minor = kVersionMinor;
    header.endian_mark = kEndianMark;
    header.header_size = sizeof(FileHeader);
    header.kind = static_cast<uint32_t>(kind);
    header.chunk_count = static_cast<uint32_t>(table.size());
    header.table_offset = bytes.size();
    const auto table_bytes = std::as_bytes(std::span(table));
    bytes.insert(bytes.end(), table_bytes.begin(), table_bytes.end());
    header.file_size = bytes.size();
    std::memcpy(bytes.data(), &header, sizeof(header));
    repairHashes(bytes);
    return AlignedBytes(bytes);
}

void repairPageHashes(std::span<std::byte> bytes)
{
    std::span<std::byte> page_table;
    std::span<const std::byte> pages;
    for (const std::span<std::byte> entry_bytes : tableEntries(bytes))
    {
        const ChunkEntry entry = readAs<ChunkEntry>(entry_bytes);
        if (entry.type == kChunkPageTable && entry.codec == static_cast<uint32_t>(Codec::none))
            page_table = writable(bytes, entry.offset, entry.stored_size);
        if (entry.type == kChunkPages)
            pages = writable(bytes, entry.offset, entry.stored_size);
    }
    for (size_t at = 0; at + sizeof(PageRecord) <= page_table.size(); at += sizeof(PageRecord))
    {
        auto record = readAs<PageRecord>(page_table.subspan(at));
        if (const auto stored = checkedPart(pages, record.offset, record.stored_size))
            record.hash = hashBytes(*stored);
        std::memcpy(page_table.data() + at, &record, sizeof(record));
    }
}

void repairHashes(std::span<std::byte> bytes)
{
    if (bytes.size() < sizeof(FileHeader))
        return;
    uint64_t table_size = 0;
    for (const std::span<std::byte> entry_bytes : tableEntries(bytes))
    {
        auto entry = readAs<ChunkEntry>(entry_bytes);
        entry.hash = hashBytes(writable(bytes, entry.offset, entry.stored_size));
        std::memcpy(entry_bytes.data(), &entry, sizeof(entry));
        table_size += sizeof(entry);
    }
    auto header = readAs<FileHeader>(bytes);
    header.table_hash = hashBytes(writable(bytes, header.table_offset, table_size));
    std::memcpy(bytes.data(), &header, sizeof(header));
    header.header_hash = hashBytes(bytes.first(offsetof(FileHeader, header_hash)));
    std::memcpy(bytes.data(), &header, sizeof(header));
}

} // namespace hearth::test
