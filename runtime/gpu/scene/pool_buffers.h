// Buffers of the geometry pool: a slice each, in memory of its own, so that slices may come and go
// while frames are in flight.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/records.h"
#include "runtime/gpu/vulkan/memory.h"

#include <array>
#include <optional>
#include <utility>

namespace hearth::gpu
{

class PoolBuffers
{
public:
    /// Give a slice that has no memory so many bytes. errors: device_failed.
    Status open(const Device& device, uint32_t slice, VkDeviceSize bytes)
    {
        HEARTH_ASSERT(!hasMemory(slice));
        Slice fresh{MemoryArena(device, 0), {}};
        HEARTH_ASSIGN_OR_RETURN(fresh.buffer, fresh.arena.createBuffer(bytes, kUsage, MemoryKind::device));
        slices_[slice] = std::move(fresh);
        return success();
    }

    /// Take a slice from the frames after `last_serial`. Its memory stays until that frame has
    /// completed.
    void close(uint32_t slice, uint64_t last_serial)
    {
        HEARTH_ASSERT(slice > 0 && isOpen(slice));
        slices_[slice]->is_closed = true;
        slices_[slice]->last_serial = last_serial;
    }

    /// Free the memory of closed slices that no frame after `completed_serial` reads.
    void release(uint64_t completed_serial)
    {
        for (std::optional<Slice>& slice : slices_)
            if (slice.has_value() && slice->is_closed && slice->last_serial <= completed_serial)
                slice.reset();
    }

    bool isOpen(uint32_t slice) const { return slices_[slice].has_value() && !slices_[slice]->is_closed; }
    bool hasMemory(uint32_t slice) const { return slices_[slice].has_value(); }

    /// Return the buffer to bind: of a slice that is not open, the first slice's, since descriptors
    /// must be valid. The first slice is open (asserted).
    const Buffer& operator[](uint32_t slice) const
    {
        HEARTH_ASSERT(isOpen(0));
        return slices_[isOpen(slice) ? slice : 0]->buffer;
    }

    /// Return the bytes of all slices that have memory.
    VkDeviceSize bytes() const
    {
        VkDeviceSize bytes = 0;
        for (const std::optional<Slice>& slice : slices_)
            bytes += slice.has_value() ? slice->buffer.size : 0;
        return bytes;
    }

private:
    static constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                 VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                                 VK_BUFFER_USAGE_TRANSFER_SRC_BIT;

    struct Slice
    {
        MemoryArena arena; ///< before the buffer, which must be destroyed first
        Buffer buffer;
        bool is_closed = false;
        uint64_t last_serial = 0; ///< last frame that may read it, once it is closed
    };
    std::array<std::optional<Slice>, shared::kPoolSlices> slices_;
};

} // namespace hearth::gpu
