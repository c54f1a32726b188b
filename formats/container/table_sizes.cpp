// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/container/table_sizes.h"

#include "formats/container/container_reader.h"
#include "formats/records/chunk_list.h"

namespace hearth::formats
{

namespace
{

bool isTable(const ChunkEntry& entry)
{
    const ChunkInfo* info = chunkInfo(entry.type);
    return info != nullptr && !info->one_per_index && entry.type != kChunkPages;
}

} // namespace

Status checkTableSizes(std::span<const ChunkEntry> chunks, Issue issue, const std::string& file)
{
    uint64_t decoded = 0; // at most kMaxTableBytes a chunk, and a chunk takes 64 bytes of the file
    uint64_t stored = 0;
    const ChunkEntry* largest = nullptr;
    for (const ChunkEntry& entry : chunks)
    {
        if (!isTable(entry))
            continue;
        if (entry.size > kMaxTableBytes)
            return Error{issue, file, chunkName(entry.type, entry.index),
                         "a table of " + std::to_string(entry.size) + " bytes, at most " +
                             std::to_string(kMaxTableBytes) + " are possible"};
        if (entry.codec == static_cast<uint32_t>(Codec::none))
            continue;
        decoded += entry.size;
        stored += entry.stored_size;
        if (largest == nullptr || entry.size > largest->size)
            largest = &entry;
    }
    if (decoded > kMaxUniformTableBytes &&
        (decoded - kMaxUniformTableBytes) / kMaxBytesPerStoredByte > stored)
        return Error{issue, file, chunkName(largest->type, largest->index),
                     "the tables decode to " + std::to_string(decoded) + " bytes from " +
                         std::to_string(stored) + " in the file, at most " +
                         std::to_string(kMaxUniformTableBytes) + " and " +
                         std::to_string(kMaxBytesPerStoredByte) + " for each of these are possible"};
    return success();
}

} // namespace hearth::formats
