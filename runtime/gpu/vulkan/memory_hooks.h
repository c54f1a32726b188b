// Device memory from the caller's allocator.
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
};

/// Of one buffer or image.
struct MemoryRequest
{
    VkMemoryRequirements needs;
    MemoryKind kind;
    bool image; ///< optimally tiled: bufferImageGranularity is the allocator's to keep
};

struct MemoryPiece
{
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    std::byte* mapped = nullptr; ///< where the piece begins; of kinds that are mapped
    void* allocation = nullptr;  ///< the allocator's own
};

/// Called while scenes, targets and passes are created and destroyed, by the thread that does so; never while a frame is
/// recorded. Both functions, or neither: then memory comes in blocks from vkAllocateMemory.
struct MemoryHooks
{
    void* user = nullptr;
    /// A piece of a type that `needs` allows and that has the properties of the kind, mapped where the kind is until it is freed.
    VkResult (*allocate)(void* user, const MemoryRequest& request, MemoryPiece& piece) = nullptr;
    /// Nothing uses what is bound to it any more.
    void (*free)(void* user, const MemoryPiece& piece) = nullptr;
};

} // namespace hearth::gpu
