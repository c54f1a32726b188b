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
                                            VkDeviceSize spare, VkBufferUsageFlags usage, bool keeps_earlier)
{
    MirroredTable mirrored;
    const VkDeviceSize table_bytes = keeps_earlier ? 2 * bytes : bytes;
    mirrored.table_.resize(static_cast<size_t>(table_bytes));
    mirrored.copies_.resize(copies);
    for (Copy& copy : mirrored.copies_)
    {
        HEARTH_ASSIGN_OR_RETURN(copy.buffer,
                                arena.createBuffer(table_bytes + spare, usage, MemoryKind::upload));
        std::memset(copy.buffer.mapped, 0, static_cast<size_t>(copy.buffer.size));
        copy.stale.reserve(kMaxStaleRanges);
    }
    if (keeps_earlier)
    {
        mirrored.earlier_ = bytes;
        mirrored.changed_.reserve(kMaxStaleRanges);
    }
    return mirrored;
}

void MirroredTable::fill(std::span<const std::byte> bytes)
{
    HEARTH_ASSERT(bytes.size() <= (earlier_ > 0 ? earlier_ : table_.size()));
    if (bytes.empty())
        return;
    std::memcpy(table_.data(), bytes.data(), bytes.size());
    if (earlier_ > 0)
        std::memcpy(table_.data() + earlier_, bytes.data(), bytes.size());
    for (Copy& copy : copies_)
        std::memcpy(copy.buffer.mapped, table_.data(), table_.size());
}

void MirroredTable::add(std::vector<Range>& ranges, Range range, VkDeviceSize table_bytes)
{
    const bool continues = !ranges.empty() && ranges.back().offset + ranges.back().size == range.offset;
    if (continues)
        ranges.back().size += range.size;
    else if (ranges.size() < kMaxStaleRanges)
        ranges.push_back(range);
    else
        ranges.assign(1, {0, table_bytes});
}

void MirroredTable::write(VkDeviceSize offset, std::span<const std::byte> bytes)
{
    HEARTH_ASSERT(offset + bytes.size() <= table_.size());
    std::memcpy(table_.data() + offset, bytes.data(), bytes.size());
    for (Copy& copy : copies_)
        add(copy.stale, {offset, bytes.size()}, table_.size());
    if (offset < earlier_)
        add(changed_, {offset, bytes.size()}, earlier_);
}

void MirroredTable::keepEarlier()
{
    for (const Range& range : changed_)
        write(earlier_ + range.offset,
              std::span(table_).subspan(static_cast<size_t>(range.offset), static_cast<size_t>(range.size)));
    changed_.clear();
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
