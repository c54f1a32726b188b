// Hooks for the caller's device memory allocator.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/device_table.h"

#include <cstddef>

namespace hearth::gpu
{

enum class MemoryKind
{
    device,   ///< fastest for the GPU; not mapped
    staging,  ///< mapped and coherent, written by the CPU
    readback, ///< mapped and coherent, read by the CPU; cached where there is such memory
    /// Attachments that never leave the tile: lazily allocated where there is such memory, else as `device`.
    transient,
    /// Mapped and coherent, written by the CPU and read by the GPU in place: device-local where such memory
    /// is visible to the CPU.
    upload,
};

/// Request for the memory of one buffer or image.
struct MemoryRequest
{
    VkMemoryRequirements needs;
    MemoryKind kind;
    bool image; ///< optimally tiled: the allocator must respect bufferImageGranularity
};

struct MemoryAllocation
{
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    std::byte* mapped = nullptr; ///< address of the allocation; for mapped kinds
    void* allocation = nullptr;  ///< private to the allocator
};

/// Called on the calling thread while scenes, targets and passes are created and destroyed; of scenes with a
/// memory budget also while a frame begins or is recorded, for streamed images and slices of the pool. Set
/// both functions, or neither: then memory comes in blocks from vkAllocateMemory.
struct MemoryHooks
{
    void* user = nullptr;
    /// Allocate from a type that `needs` allows and that has the properties of the kind. Mapped kinds stay
    /// mapped until they are freed.
    VkResult (*allocate)(void* user, const MemoryRequest& request, MemoryAllocation& piece) = nullptr;
    /// Free an allocation. Nothing bound to it is in use any more.
    void (*free)(void* user, const MemoryAllocation& piece) = nullptr;
};

} // namespace hearth::gpu
