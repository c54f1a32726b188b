// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/mirrored_table.h"

#include "formats/base/assert.h"

#include <cstring>

namespace hearth::gpu
{

namespace
{

/// Ranges of a copy that are kept apart. More of them become one, so that recording allocates nothing.
constexpr size_t kMaxStaleRanges = 4096;

} // namespace

Result<MirroredTable> MirroredTable::create(MemoryArena& arena, uint32_t copies, VkDeviceSize bytes,
                                            VkDeviceSize spare, VkBufferUsageFlags usage)
{
    MirroredTable mirrored;
    mirrored.table_.resize(static_cast<size_t>(bytes));
    mirrored.copies_.resize(copies);
    for (Copy& copy : mirrored.copies_)
    {
        HEARTH_ASSIGN_OR_RETURN(copy.buffer, arena.createBuffer(bytes + spare, usage, MemoryKind::upload));
        std::memset(copy.buffer.mapped, 0, static_cast<size_t>(copy.buffer.size));
        copy.stale.reserve(kMaxStaleRanges);
    }
    return mirrored;
}

void MirroredTable::fill(std::span<const std::byte> bytes)
{
    HEARTH_ASSERT(bytes.size() <= table_.size());
    if (bytes.empty())
        return;
    std::memcpy(table_.data(), bytes.data(), bytes.size());
    for (Copy& copy : copies_)
        std::memcpy(copy.buffer.mapped, bytes.data(), bytes.size());
}

void MirroredTable::write(VkDeviceSize offset, std::span<const std::byte> bytes)
{
    HEARTH_ASSERT(offset + bytes.size() <= table_.size());
    std::memcpy(table_.data() + offset, bytes.data(), bytes.size());
    for (Copy& copy : copies_)
    {
        const bool continues =
            !copy.stale.empty() && copy.stale.back().offset + copy.stale.back().size == offset;
        if (continues)
            copy.stale.back().size += bytes.size();
        else if (copy.stale.size() < kMaxStaleRanges)
            copy.stale.push_back({offset, bytes.size()});
        else
            copy.stale.assign(1, {0, table_.size()});
    }
}

void MirroredTable::update(uint32_t number)
{
    Copy& copy = copies_[number];
    for (const Range& range : copy.stale)
        std::memcpy(copy.buffer.mapped + range.offset, table_.data() + range.offset,
                    static_cast<size_t>(range.size));
    copy.stale.clear();
}

} // namespace hearth::gpu
