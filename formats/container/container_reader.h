// Reads a container from untrusted bytes: all structure is checked before a span is returned.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "formats/records/container.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hearth::formats
{

/// Amount of checking in open().
enum class Check
{
    everything, ///< every byte of the file: header, table, padding, the hash of every chunk
    structure,  ///< header, table and ranges; a chunk's hash is checked when it is read
};

/// Content of a chunk: bytes in the mapped file, or a decompressed copy with shared ownership. Cheap to copy.
class ChunkData
{
public:
    ChunkData() = default;
    ChunkData(std::span<const std::byte> bytes, std::shared_ptr<const void> owner)
        : bytes_(bytes), owner_(std::move(owner))
    {
    }
    std::span<const std::byte> bytes() const { return bytes_; }

private:
    std::span<const std::byte> bytes_;
    std::shared_ptr<const void> owner_;
};

/// Records of a chunk; spans are valid as long as it lives.
template <typename T>
class Records
{
public:
    Records() = default;
    explicit Records(ChunkData data) : data_(std::move(data)) {}
    std::span<const T> span() const
    {
        return {reinterpret_cast<const T*>(data_.bytes().data()), data_.bytes().size() / sizeof(T)};
    }
    size_t size() const { return span().size(); }
    const T& operator[](size_t i) const { return span()[i]; }
    auto begin() const { return span().begin(); }
    auto end() const { return span().end(); }

private:
    ChunkData data_;
};

class ContainerReader
{
public:
    /// Map the file and check it. errors: input_missing, container_*, chunk_hash, chunk_size (tables that
    /// decode to more than is possible).
    static Result<ContainerReader> open(const std::string& path, Check check = Check::everything);

    /// Open bytes in memory, 64-byte aligned, that outlive the reader. `name` is used in messages.
    static Result<ContainerReader> fromBytes(std::span<const std::byte> bytes, std::string name,
                                             Check check = Check::everything);

    const std::string& name() const { return name_; }
    ContainerKind kind() const { return static_cast<ContainerKind>(header_.kind); }
    const FileHeader& header() const { return header_; }
    std::span<const ChunkEntry> chunks() const { return table_; }

    /// Return the entry of a chunk, or nullptr. Time O(log chunks).
    const ChunkEntry* find(uint32_t type, uint32_t index = 0) const;

    /// Return the stored bytes of a chunk: still compressed, and hashed only by open(Check::everything).
    std::span<const std::byte> stored(const ChunkEntry& entry) const;

    /// Check what open(Check::everything) checks beyond the structure. errors: container_padding, chunk_hash.
    Status checkContents() const;

    /// Return the decompressed content; empty if the chunk does not exist. errors: chunk_hash, chunk_codec.
    Result<ChunkData> read(uint32_t type, uint32_t index = 0) const;

    /// Return the memory of a chunk's stored bytes to the system. A later access reads them from the file
    /// again.
    void discard(const ChunkEntry& entry) const;

    /// Check that the content decompresses to the size in the table, without keeping it. errors: chunk_hash,
    /// chunk_codec.
    Status checkDecodes(const ChunkEntry& entry) const;

    /// Return the content as records. errors: those of read, and chunk_size if it is not a whole number of T.
    template <typename T>
    Result<Records<T>> records(uint32_t type, uint32_t index = 0) const
    {
        const ChunkEntry* entry = find(type, index);
        if (entry != nullptr && entry->element_size != sizeof(T))
            return makeSizeError(*entry, sizeof(T));
        HEARTH_ASSIGN_OR_RETURN(ChunkData data, read(type, index));
        return Records<T>(std::move(data));
    }

private:
    Status checkStructure();
    Error makeSizeError(const ChunkEntry& entry, size_t element_size) const;

    std::string name_;
    std::span<const std::byte> bytes_;
    std::shared_ptr<const void> owner_; ///< mapping of the file, or null
    FileHeader header_{};
    std::vector<ChunkEntry> table_;
    std::vector<uint32_t> entries_by_id_; ///< entries sorted by type and index
    Check check_ = Check::everything;
};

/// Return the name of a chunk in messages: "MESH 3".
std::string chunkName(uint32_t type, uint32_t index);

/// Return the XXH3-64 hash, the hash of the format.
uint64_t hashBytes(std::span<const std::byte> bytes);

/// True if all bytes are zero.
bool allZero(std::span<const std::byte> bytes);

/// Decompress one zstd frame of known content size; false if it fails or the size differs.
bool decompress(std::span<const std::byte> stored, std::span<std::byte> out);

/// True if `stored` is exactly one zstd frame that declares `size` as its content size and is long enough to
/// hold that much. Does not decompress it: ask before memory is allocated for decompress().
bool isSingleFrame(std::span<const std::byte> stored, uint64_t size);

} // namespace hearth::formats
