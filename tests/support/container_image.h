// Containers put together in memory, byte by byte as FORMAT.md says and without ContainerWriter: for tests that need
// files that no writer makes, and to hold the writer against.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/container.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hearth::test
{

/// Bytes at an address that is a multiple of 64, as a mapped file's are.
class AlignedBytes
{
public:
    AlignedBytes() = default;
    explicit AlignedBytes(std::span<const std::byte> bytes);
    AlignedBytes(const AlignedBytes& other) : AlignedBytes(other.span()) {}
    AlignedBytes(AlignedBytes&&) noexcept = default;
    AlignedBytes& operator=(AlignedBytes other) noexcept;
    std::span<std::byte> span() { return {data(), size_}; }
    std::span<const std::byte> span() const { return {data(), size_}; }
    size_t size() const { return size_; }

private:
    struct alignas(formats::kChunkAlignment) Block
    {
        std::byte bytes[formats::kChunkAlignment];
    };
    std::byte* data() { return reinterpret_cast<std::byte*>(blocks_.data()); }
    const std::byte* data() const { return reinterpret_cast<const std::byte*>(blocks_.data()); }
    std::vector<Block> blocks_;
    size_t size_ = 0;
};

struct ChunkImage
{
    formats::ChunkEntry entry{}; ///< type, index, version, codec, element_size; size where codec is not none
    std::vector<std::byte> stored;
};

/// A chunk stored as it is.
ChunkImage plainChunk(uint32_t type, uint32_t index, uint32_t element_size, std::span<const std::byte> bytes);

/// The same compressed, always, by zstd.
ChunkImage zstdChunk(uint32_t type, uint32_t index, uint32_t element_size, std::span<const std::byte> bytes);

/// The same, but its frame does not name the size of what is in it, as streams do not.
ChunkImage streamedChunk(uint32_t type, uint32_t index, uint32_t element_size,
                         std::span<const std::byte> bytes);

/// Lay the chunks out and fill in offsets, sizes, hashes and the header.
AlignedBytes assemble(formats::ContainerKind kind, std::span<const ChunkImage> chunks);

/// Make the hashes of chunks, table and header right again after bytes were changed. Does what it can where the table
/// itself is nonsense, and never leaves `bytes`.
void repairHashes(std::span<std::byte> bytes);

/// The same for the hashes in an uncompressed page table; to be called before repairHashes.
void repairPageHashes(std::span<std::byte> bytes);

} // namespace hearth::test
