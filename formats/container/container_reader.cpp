// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/container/container_reader.h"

#include "formats/base/byte_reader.h"
#include "formats/base/regular_file.h"
#include "formats/container/table_sizes.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <numeric>
#include <sys/mman.h>
#include <unistd.h>
#include <xxhash.h>
#include <zstd.h>

namespace hearth::formats
{

namespace
{

// Maximum size of a decompressed chunk: a larger claim is a decompression bomb.
constexpr uint64_t kMaxChunkSize = uint64_t{1} << 32;

struct Mapping
{
    void* address = nullptr;
    size_t size = 0;
    ~Mapping()
    {
        if (address != nullptr)
            ::munmap(address, size);
    }
};

std::pair<uint32_t, uint32_t> chunkKey(const ChunkEntry& entry)
{
    return {entry.type, entry.index};
}

/// True if decompress() of a single frame succeeds, tested with a small buffer.
bool decompressesTo(std::span<const std::byte> stored, uint64_t size)
{
    if (!isSingleFrame(stored, size))
        return false;
    const std::unique_ptr<ZSTD_DCtx, size_t (*)(ZSTD_DCtx*)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
    std::vector<std::byte> buffer(ZSTD_DStreamOutSize());
    ZSTD_inBuffer in{stored.data(), stored.size(), 0};
    uint64_t total = 0;
    for (;;)
    {
        ZSTD_outBuffer out{buffer.data(), buffer.size(), 0};
        const size_t rest = ZSTD_decompressStream(context.get(), &out, &in);
        total += out.pos;
        if (ZSTD_isError(rest) || total > size)
            return false;
        if (rest == 0)
            return in.pos == in.size && total == size;
        if (out.pos == 0 && in.pos == in.size)
            return false;
    }
}

/// Call function(stored, size of the content) for each frame until it returns false.
/// returns  true if it never did, and the frames cover `stored` and have `size` bytes of content together
template <typename Function>
bool forEachFrame(std::span<const std::byte> stored, uint64_t size, const Function& function)
{
    while (!stored.empty())
    {
        const size_t frame = ZSTD_findFrameCompressedSize(stored.data(), stored.size());
        const unsigned long long content = ZSTD_getFrameContentSize(stored.data(), stored.size());
        if (ZSTD_isError(frame) || content == 0 || content > size || !function(stored.first(frame), content))
            return false;
        stored = stored.subspan(frame);
        size -= content;
    }
    return size == 0;
}

bool areFrames(std::span<const std::byte> stored, uint64_t size)
{
    return forEachFrame(stored, size, isSingleFrame);
}

/// Decompress all frames into `out`, which their contents fill.
bool decompressFrames(std::span<const std::byte> stored, std::span<std::byte> out)
{
    return forEachFrame(stored, out.size(),
                        [&](std::span<const std::byte> frame, uint64_t size)
                        {
                            const bool is_decoded = decompress(frame, out.first(static_cast<size_t>(size)));
                            out = out.subspan(static_cast<size_t>(size));
                            return is_decoded;
                        });
}

bool isDecodable(std::span<const std::byte> stored, Codec codec, uint64_t size)
{
    switch (codec)
    {
    case Codec::none:
        return true;
    case Codec::zstd:
        return decompressesTo(stored, size);
    case Codec::zstd_frames:
        return forEachFrame(stored, size, decompressesTo);
    }
    return false;
}

} // namespace

bool allZero(std::span<const std::byte> bytes)
{
    return std::all_of(bytes.begin(), bytes.end(), [](std::byte b) { return b == std::byte{0}; });
}

uint64_t hashBytes(std::span<const std::byte> bytes)
{
    return XXH3_64bits(bytes.data(), bytes.size());
}

bool isSingleFrame(std::span<const std::byte> stored, uint64_t size)
{
    // a block takes 4 bytes or more and holds 128 KiB or less
    constexpr uint64_t kMinBlockBytes = 4;
    return size / ZSTD_BLOCKSIZE_MAX <= stored.size() / kMinBlockBytes &&
           ZSTD_getFrameContentSize(stored.data(), stored.size()) == size &&
           ZSTD_findFrameCompressedSize(stored.data(), stored.size()) == stored.size();
}

bool decompress(std::span<const std::byte> stored, std::span<std::byte> out)
{
    return isSingleFrame(stored, out.size()) &&
           ZSTD_decompress(out.data(), out.size(), stored.data(), stored.size()) == out.size();
}

std::string chunkName(uint32_t type, uint32_t index)
{
    std::string name;
    for (int i = 0; i < 4; ++i)
    {
        const char c = static_cast<char>(type >> (8 * i));
        name += c >= 0x20 && c < 0x7F ? c : '?';
    }
    return "chunk " + name + " " + std::to_string(index);
}

Result<ContainerReader> ContainerReader::open(const std::string& path, Check check)
{
    HEARTH_ASSIGN_OR_RETURN(const RegularFile file, openRegular(path));
    auto mapping = std::make_shared<Mapping>();
    mapping->size = static_cast<size_t>(file.size());
    if (mapping->size > 0)
    {
        void* address = ::mmap(nullptr, mapping->size, PROT_READ, MAP_PRIVATE, file.descriptor(), 0);
        if (address == MAP_FAILED)
            return Error{Issue::read_failed, path, "", std::string("cannot map: ") + std::strerror(errno)};
        mapping->address = address;
    }

    const std::span<const std::byte> bytes(static_cast<const std::byte*>(mapping->address), mapping->size);
    HEARTH_ASSIGN_OR_RETURN(ContainerReader reader, fromBytes(bytes, path, check));
    reader.owner_ = mapping;
    return reader;
}

Result<ContainerReader> ContainerReader::fromBytes(std::span<const std::byte> bytes, std::string name,
                                                   Check check)
{
    HEARTH_ASSERT(reinterpret_cast<uintptr_t>(bytes.data()) % alignof(uint64_t) == 0);
    ContainerReader reader;
    reader.name_ = std::move(name);
    reader.bytes_ = bytes;
    reader.check_ = check;
    HEARTH_TRY(reader.checkStructure());
    if (check == Check::everything)
        HEARTH_TRY(reader.checkContents());
    return reader;
}

Status ContainerReader::checkStructure()
{
    const auto fail = [&](Issue issue, std::string detail, std::string where = "") {
        return Error{issue, name_, std::move(where), std::move(detail)};
    };

    const auto header = ByteReader(bytes_).read<FileHeader>();
    if (!header)
        return fail(Issue::container_truncated,
                    std::to_string(bytes_.size()) + " bytes are too few for a header");
    header_ = *header;
    if (std::memcmp(header_.magic, kMagic, sizeof(kMagic)) != 0)
        return fail(Issue::container_magic, "");
    if (header_.endian_mark != kEndianMark)
        return fail(Issue::container_endian, "");
    if (header_.version_major != kVersionMajor)
        return fail(Issue::container_version, "version " + std::to_string(header_.version_major) + "." +
                                                  std::to_string(header_.version_minor) + ", this is " +
                                                  std::to_string(kVersionMajor));
    if (hashBytes(bytes_.first(offsetof(FileHeader, header_hash))) != header_.header_hash ||
        header_.header_size != sizeof(FileHeader) || !allZero(std::as_bytes(std::span(header_.reserved))))
        return fail(Issue::container_header, "");
    if (header_.required_features != 0)
        return fail(Issue::container_feature, "feature bits " + std::to_string(header_.required_features));
    if (header_.file_size != bytes_.size())
        return fail(Issue::container_size, std::to_string(bytes_.size()) + " bytes, written with " +
                                               std::to_string(header_.file_size));

    const auto table = checkedPart(bytes_, header_.table_offset, header_.chunk_count, sizeof(ChunkEntry));
    if (!table || header_.table_offset % kChunkAlignment != 0 || header_.table_offset < sizeof(FileHeader) ||
        header_.table_offset + table->size() != bytes_.size() || hashBytes(*table) != header_.table_hash)
        return fail(Issue::container_table, "");
    table_.resize(header_.chunk_count);
    if (!table->empty())
        std::memcpy(table_.data(), table->data(), table->size());

    // Chunks are in table order, contiguous, with less than one alignment of zeros between.
    uint64_t at = sizeof(FileHeader);
    for (const ChunkEntry& entry : table_)
    {
        const std::string where = chunkName(entry.type, entry.index);
        at = alignChunk(at);
        if (entry.offset != at || entry.stored_size > header_.table_offset - at || entry.element_size == 0 ||
            entry.size % entry.element_size != 0 ||
            entry.size > kMaxChunkSize * (entry.codec == 0 ? 16 : 1) ||
            !allZero(std::as_bytes(std::span(entry.reserved))))
            return fail(Issue::container_table, "the table's entry is not valid", where);
        const bool stored = entry.codec == static_cast<uint32_t>(Codec::none);
        if (stored ? entry.size != entry.stored_size
                   : entry.codec > static_cast<uint32_t>(Codec::zstd_frames))
            return fail(Issue::container_table, "sizes and codec do not agree", where);
        at += entry.stored_size;
    }
    at = alignChunk(at);
    if (at != header_.table_offset)
        return fail(Issue::container_table, "there are bytes that belong to no chunk");

    HEARTH_TRY(checkTableSizes(table_, Issue::chunk_size, name_));

    entries_by_id_.resize(table_.size());
    std::iota(entries_by_id_.begin(), entries_by_id_.end(), 0u);
    std::sort(entries_by_id_.begin(), entries_by_id_.end(),
              [this](uint32_t a, uint32_t b) { return chunkKey(table_[a]) < chunkKey(table_[b]); });
    const auto twice = std::adjacent_find(entries_by_id_.begin(), entries_by_id_.end(),
                                          [this](uint32_t a, uint32_t b)
                                          { return chunkKey(table_[a]) == chunkKey(table_[b]); });
    if (twice != entries_by_id_.end())
        return fail(Issue::container_table, "the chunk occurs twice",
                    chunkName(table_[*twice].type, table_[*twice].index));
    return success();
}

Status ContainerReader::checkContents() const
{
    uint64_t at = sizeof(FileHeader);
    const auto paddingIsZero = [&](uint64_t until)
    { return allZero(bytes_.subspan(static_cast<size_t>(at), static_cast<size_t>(until - at))); };
    for (const ChunkEntry& entry : table_)
    {
        if (!paddingIsZero(entry.offset))
            return Error{Issue::container_padding, name_, chunkName(entry.type, entry.index), ""};
        if (hashBytes(stored(entry)) != entry.hash)
            return Error{Issue::chunk_hash, name_, chunkName(entry.type, entry.index), ""};
        at = entry.offset + entry.stored_size;
    }
    if (!paddingIsZero(header_.table_offset))
        return Error{Issue::container_padding, name_, "", ""};
    return success();
}

const ChunkEntry* ContainerReader::find(uint32_t type, uint32_t index) const
{
    const std::pair<uint32_t, uint32_t> id{type, index};
    const auto found =
        std::lower_bound(entries_by_id_.begin(), entries_by_id_.end(), id,
                         [this](uint32_t entry, const auto& key) { return chunkKey(table_[entry]) < key; });
    return found == entries_by_id_.end() || chunkKey(table_[*found]) != id ? nullptr : &table_[*found];
}

std::span<const std::byte> ContainerReader::stored(const ChunkEntry& entry) const
{
    return bytes_.subspan(static_cast<size_t>(entry.offset), static_cast<size_t>(entry.stored_size));
}

Result<ChunkData> ContainerReader::read(uint32_t type, uint32_t index) const
{
    const ChunkEntry* entry = find(type, index);
    if (entry == nullptr)
        return ChunkData();
    const std::span<const std::byte> bytes = stored(*entry);
    if (check_ == Check::structure && hashBytes(bytes) != entry->hash)
        return Error{Issue::chunk_hash, name_, chunkName(type, index), ""};
    if (entry->codec == static_cast<uint32_t>(Codec::none))
        return ChunkData(bytes, owner_);

    struct alignas(kChunkAlignment) Block
    {
        std::byte bytes[kChunkAlignment];
    };
    const bool is_one_frame = entry->codec == static_cast<uint32_t>(Codec::zstd);
    if (is_one_frame ? !isSingleFrame(bytes, entry->size) : !areFrames(bytes, entry->size))
        return Error{Issue::chunk_codec, name_, chunkName(type, index), ""};
    // not set to zero: the system hands out memory as decoded bytes arrive, not by what the table claims
    const size_t block_count = static_cast<size_t>((entry->size + kChunkAlignment - 1) / kChunkAlignment);
    const std::shared_ptr<Block[]> blocks(new Block[block_count]);
    const std::span<std::byte> out(reinterpret_cast<std::byte*>(blocks.get()),
                                   static_cast<size_t>(entry->size));
    if (is_one_frame ? !decompress(bytes, out) : !decompressFrames(bytes, out))
        return Error{Issue::chunk_codec, name_, chunkName(type, index), ""};
    return ChunkData(out, blocks);
}

void ContainerReader::discard(const ChunkEntry& entry) const
{
    if (owner_ == nullptr)
        return;
    const std::span<const std::byte> bytes = stored(entry);
    // whole pages of memory only: the first and the last page contain other data as well
    const auto page = static_cast<size_t>(::sysconf(_SC_PAGESIZE));
    const size_t before = (page - reinterpret_cast<uintptr_t>(bytes.data()) % page) % page;
    if (bytes.size() < before)
        return;
    const size_t size = (bytes.size() - before) / page * page;
    ::madvise(const_cast<std::byte*>(bytes.data()) + before, size, MADV_DONTNEED);
}

Status ContainerReader::checkDecodes(const ChunkEntry& entry) const
{
    const std::span<const std::byte> bytes = stored(entry);
    if (check_ == Check::structure && hashBytes(bytes) != entry.hash)
        return Error{Issue::chunk_hash, name_, chunkName(entry.type, entry.index), ""};
    if (!isDecodable(bytes, static_cast<Codec>(entry.codec), entry.size))
        return Error{Issue::chunk_codec, name_, chunkName(entry.type, entry.index), ""};
    return success();
}

Error ContainerReader::makeSizeError(const ChunkEntry& entry, size_t element_size) const
{
    return {Issue::chunk_size, name_, chunkName(entry.type, entry.index),
            "records of " + std::to_string(entry.element_size) + " bytes, expected " +
                std::to_string(element_size)};
}

} // namespace hearth::formats
