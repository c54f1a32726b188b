// Table that frames change and several frames read at once: one mapped copy for each frame in flight, brought
// up to date by the CPU before its frame is recorded. No frame waits for another one's reads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/memory.h"

#include <span>
#include <vector>

namespace hearth::gpu
{

class MirroredTable
{
public:
    MirroredTable() = default;

    /// Create a table with zeros in it.
    /// copies  frames in flight
    /// bytes   of the table
    /// spare   bytes behind the table in each copy, which the device writes and reads
    /// keeps_earlier  the table follows once more, ahead of the spare bytes, in an earlier state
    /// errors: device_failed.
    static Result<MirroredTable> create(MemoryArena& arena, uint32_t copies, VkDeviceSize bytes,
                                        VkDeviceSize spare, VkBufferUsageFlags usage,
                                        bool keeps_earlier = false);

    /// Set the content of all copies, from the front, before any frame is recorded.
    void fill(std::span<const std::byte> bytes);

    /// Change a part of the table: `update` brings it to each copy.
    void write(VkDeviceSize offset, std::span<const std::byte> bytes);

    template <typename Record>
    void writeRow(uint32_t row, const Record& record)
    {
        write(row * VkDeviceSize{sizeof(Record)}, std::as_bytes(std::span(&record, 1)));
    }

    /// Bytes from the table to its earlier state; 0: none is kept.
    VkDeviceSize earlierOffset() const { return earlier_; }
    /// Make what the table has now its earlier state. Takes time for what has changed since the last call.
    void keepEarlier();

    /// Bring a copy up to date. No frame reads it.
    void update(uint32_t copy);

    const Buffer& copy(uint32_t number) const { return copies_[number].buffer; }

private:
    struct Range
    {
        VkDeviceSize offset, size;
    };
    struct Copy
    {
        Buffer buffer;
        std::vector<Range> stale; ///< of the table; one range of all of it once there are too many
    };

    static void add(std::vector<Range>& ranges, Range range, VkDeviceSize table_bytes);

    std::vector<std::byte> table_; ///< with its earlier state
    std::vector<Copy> copies_;
    VkDeviceSize earlier_ = 0;
    std::vector<Range> changed_; ///< since keepEarlier; as Copy::stale
};

} // namespace hearth::gpu
