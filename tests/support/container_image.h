// Builds containers in memory, byte by byte as in formats/FORMAT.md and without ContainerWriter: for tests
// that need files that no writer makes, and to check the writer.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/container.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hearth::test
{

/// Bytes at an address that is a multiple of 64, like the bytes of a mapped file.
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

/// Make a chunk that is stored uncompressed.
ChunkImage plainChunk(uint32_t type, uint32_t index, uint32_t element_size, std::span<const std::byte> bytes);

/// Make a chunk that is always compressed by zstd.
ChunkImage zstdChunk(uint32_t type, uint32_t index, uint32_t element_size, std::span<const std::byte> bytes);

/// Make a chunk of several zstd frames.
/// sizes  of their contents
ChunkImage framesChunk(uint32_t type, uint32_t index, std::span<const std::byte> bytes,
                       std::span<const uint32_t> sizes);

/// Make a compressed chunk whose frame does not store the size of its content, as streams do.
ChunkImage streamedChunk(uint32_t type, uint32_t index, uint32_t element_size,
                         std::span<const std::byte> bytes);

/// Lay the chunks out and fill in offsets, sizes, hashes and the header.
AlignedBytes assemble(formats::ContainerKind kind, std::span<const ChunkImage> chunks);

/// Recompute the hashes of chunks, table and header after bytes were changed. Does what it can if the table
/// is invalid, and never accesses memory outside `bytes`.
void repairHashes(std::span<std::byte> bytes);

/// Recompute the hashes in an uncompressed page table; call it before repairHashes.
void repairPageHashes(std::span<std::byte> bytes);

} // namespace hearth::test
