// Counts the bytes that a renderer has on a device, by allocating each buffer and image itself.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/memory_hooks.h"

#include <cstdint>

namespace hearth::bench
{

/// Allocator of a device. Outlives the renderers that use its hooks.
class MemoryMeter
{
public:
    struct Bytes
    {
        uint64_t images = 0;
        uint64_t all = 0; ///< buffers as well
    };

    /// get_device_proc_addr  of the device, which outlives the meter
    MemoryMeter(VkDevice device, const VkPhysicalDeviceMemoryProperties& memory,
                PFN_vkGetDeviceProcAddr get_device_proc_addr);

    gpu::MemoryHooks hooks() { return {this, allocate, free}; }
    const Bytes& live() const { return live_; }
    const Bytes& peak() const { return peak_; }
    /// Count the peak from now on.
    void resetPeak() { peak_ = live_; }

private:
    static VkResult allocate(void* user, const gpu::MemoryRequest& request, gpu::MemoryAllocation& piece);
    static void free(void* user, const gpu::MemoryAllocation& piece);
    uint32_t findType(const gpu::MemoryRequest& request) const;

    VkDevice device_;
    VkPhysicalDeviceMemoryProperties memory_;
    PFN_vkAllocateMemory allocate_ = nullptr;
    PFN_vkFreeMemory free_ = nullptr;
    PFN_vkMapMemory map_ = nullptr;
    Bytes live_, peak_;
};

} // namespace hearth::bench
