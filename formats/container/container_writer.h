// Writes a container file atomically.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "formats/records/chunk_list.h"
#include "formats/records/container.h"

#include <memory>
#include <span>
#include <string>

namespace hearth::formats
{

struct ChunkId
{
    uint32_t type = 0;
    uint32_t index = 0;
    uint32_t version = 1;
};

/// Writer of chunks, in order, into a temporary file beside `path`; finish() renames it to `path`. Without
/// finish() nothing appears and the temporary file is removed. Deterministic: the same calls give the same
/// bytes. The zstd level is fixed, padding is zero, and no data of the machine or the time is written.
/// errors: cannot_write, naming the path.
class ContainerWriter
{
public:
    static Result<ContainerWriter> create(const std::string& path, ContainerKind kind);
    ContainerWriter(ContainerWriter&&) noexcept;
    ContainerWriter& operator=(ContainerWriter&&) noexcept;
    ~ContainerWriter();

    /// Add a whole chunk. `element_size` divides bytes.size().
    Status addChunk(ChunkId id, std::span<const std::byte> bytes, uint32_t element_size, Codec codec);

    /// Add a chunk as frames, which can be decompressed one by one (Codec::zstd_frames).
    /// sizes  bytes of each frame's content, > 0; they add up to bytes.size()
    Status addFrames(ChunkId id, std::span<const std::byte> bytes, std::span<const uint32_t> sizes);

    template <typename T>
    Status addRecords(uint32_t type, std::span<const T> records, Codec codec = Codec::zstd,
                      uint32_t index = 0)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        return addChunk({.type = type, .index = index, .version = chunkVersion(type)}, std::as_bytes(records),
                        sizeof(T), codec);
    }

    Status addText(uint32_t type, std::string_view text, Codec codec = Codec::zstd, uint32_t index = 0)
    {
        return addChunk({.type = type, .index = index}, std::as_bytes(std::span(text)), 1, codec);
    }

    /// Add a chunk as stored in another container, without compressing it again. errors: chunk_hash if
    /// `stored` does not match `entry`.
    Status addStored(ChunkId id, const ChunkEntry& entry, std::span<const std::byte> stored);

    /// Add a chunk too large to hold in memory: begin, append any number of times, end. Stored without a
    /// codec.
    Status beginChunk(ChunkId id, uint32_t element_size);
    Status append(std::span<const std::byte> bytes);
    Status endChunk();

    /// Return the number of bytes appended to the chunk that beginChunk opened.
    uint64_t chunkSize() const;

    /// Write table and header, flush to the disk, and rename into place. errors: also input_too_large, for
    /// tables that readers would refuse.
    Status finish();

private:
    struct State;
    explicit ContainerWriter(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace hearth::formats
