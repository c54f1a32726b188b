// Device memory in large blocks, and the buffers and images that live in them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/device.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hearth::gpu
{

enum class MemoryKind
{
    device,   ///< fastest for the GPU; not mapped
    staging,  ///< mapped and coherent, written by the CPU
    readback, ///< mapped and coherent, read by the CPU; cached where there is such memory
};

struct Buffer
{
    UniqueBuffer handle;
    VkDeviceSize size = 0;
    std::byte* mapped = nullptr; ///< staging and readback memory only
};

struct Image
{
    UniqueImage handle;
    UniqueImageView view;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};
    uint32_t mip_count = 1;
};

struct ImageDescription
{
    VkFormat format;
    VkExtent2D extent;
    uint32_t mip_count = 1;
    VkImageUsageFlags usage;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    uint32_t array_layers = 0; ///< 0: an image that is no array
};

/// Gives out pieces of blocks and takes nothing back: everything ends with the arena. What is made from it must
/// be destroyed before it, so it stands first among the members of its owner.
class MemoryArena
{
public:
    /// block_bytes  what is asked of the device at once: few enough allocations for the smallest
    ///              maxMemoryAllocationCount (4096), small enough not to waste a phone's memory; 0 for an arena that
    ///              holds one thing
    explicit MemoryArena(const Device& device, VkDeviceSize block_bytes = VkDeviceSize{16} << 20)
        : device_(&device), block_bytes_(block_bytes)
    {
    }

    /// A buffer of at least one byte. errors: device_failed.
    Result<Buffer> createBuffer(VkDeviceSize size, VkBufferUsageFlags usage, MemoryKind kind);
    /// A 2D image, or an array of them, with its view of all mips and layers. errors: device_failed.
    Result<Image> createImage(const ImageDescription& description);

    VkDeviceSize allocatedBytes() const;

private:
    struct Block
    {
        UniqueMemory memory;
        uint32_t type = 0;
        bool images = false; // buffers and images in separate blocks keep clear of bufferImageGranularity
        VkDeviceSize size = 0;
        VkDeviceSize used = 0;
        std::byte* mapped = nullptr;
    };
    struct Piece
    {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        VkDeviceSize offset = 0;
        std::byte* mapped = nullptr;
    };
    Result<Piece> allocate(const VkMemoryRequirements& needs, MemoryKind kind, bool image);

    const Device* device_;
    VkDeviceSize block_bytes_;
    std::vector<Block> blocks_;
};

} // namespace hearth::gpu
