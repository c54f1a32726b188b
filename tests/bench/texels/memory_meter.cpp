// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/texels/memory_meter.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <memory>

namespace hearth::bench
{

namespace
{

/// Counted allocation.
struct Counted
{
    uint64_t bytes;
    bool image;
};

} // namespace

MemoryMeter::MemoryMeter(VkDevice device, const VkPhysicalDeviceMemoryProperties& memory,
                         PFN_vkGetDeviceProcAddr get_device_proc_addr)
    : device_(device), memory_(memory)
{
    const auto load = [&]<typename T>(T& function, const char* name)
    { function = reinterpret_cast<T>(get_device_proc_addr(device, name)); };
    load(allocate_, "vkAllocateMemory");
    load(free_, "vkFreeMemory");
    load(map_, "vkMapMemory");
}

uint32_t MemoryMeter::findType(const gpu::MemoryRequest& request) const
{
    const bool mapped = request.kind != gpu::MemoryKind::device && request.kind != gpu::MemoryKind::transient;
    const VkMemoryPropertyFlags needed =
        mapped ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT : 0;
    for (uint32_t type = 0; type < memory_.memoryTypeCount; ++type)
        if ((request.needs.memoryTypeBits >> type & 1u) != 0 &&
            (memory_.memoryTypes[type].propertyFlags & needed) == needed)
            return type;
    HEARTH_ASSERT(false);
    return 0;
}

VkResult MemoryMeter::allocate(void* user, const gpu::MemoryRequest& request, gpu::MemoryAllocation& piece)
{
    auto* const self = static_cast<MemoryMeter*>(user);
    const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, request.needs.size,
                                    self->findType(request)};
    if (const VkResult result = self->allocate_(self->device_, &info, nullptr, &piece.memory);
        result != VK_SUCCESS)
        return result;
    if (request.kind != gpu::MemoryKind::device && request.kind != gpu::MemoryKind::transient)
    {
        void* mapped = nullptr;
        HEARTH_ASSERT(self->map_(self->device_, piece.memory, 0, VK_WHOLE_SIZE, 0, &mapped) == VK_SUCCESS);
        piece.mapped = static_cast<std::byte*>(mapped);
    }
    auto counted = std::make_unique<Counted>(Counted{request.needs.size, request.image});
    self->live_.all += counted->bytes;
    self->live_.images += counted->image ? counted->bytes : 0;
    self->peak_.all = std::max(self->peak_.all, self->live_.all);
    self->peak_.images = std::max(self->peak_.images, self->live_.images);
    piece.allocation = counted.release();
    return VK_SUCCESS;
}

void MemoryMeter::free(void* user, const gpu::MemoryAllocation& piece)
{
    auto* const self = static_cast<MemoryMeter*>(user);
    const std::unique_ptr<Counted> counted(static_cast<Counted*>(piece.allocation));
    self->live_.all -= counted->bytes;
    self->live_.images -= counted->image ? counted->bytes : 0;
    self->free_(self->device_, piece.memory, nullptr);
}

} // namespace hearth::bench
