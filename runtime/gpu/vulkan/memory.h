// Device memory in large blocks, and the buffers and images that live in them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/device.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hearth::gpu
{

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

/// A piece from MemoryHooks, given back when it goes.
class HookedMemory
{
public:
    HookedMemory(const MemoryHooks& hooks, const MemoryPiece& piece, VkDeviceSize size)
        : hooks_(&hooks), piece_(piece), size_(size)
    {
    }
    HookedMemory(HookedMemory&& other) noexcept
        : hooks_(std::exchange(other.hooks_, nullptr)), piece_(other.piece_), size_(other.size_)
    {
    }
    HookedMemory& operator=(HookedMemory&& other) noexcept
    {
        std::swap(hooks_, other.hooks_);
        std::swap(piece_, other.piece_);
        std::swap(size_, other.size_);
        return *this;
    }
    ~HookedMemory()
    {
        if (hooks_ != nullptr)
            hooks_->free(hooks_->user, piece_);
    }

    VkDeviceSize size() const { return size_; }

private:
    const MemoryHooks* hooks_;
    MemoryPiece piece_;
    VkDeviceSize size_;
};

/// Gives out pieces of blocks, or of the caller's hooks where there are some, and takes nothing back: everything ends with the
/// arena. What is made from it must be destroyed before it, so it stands first among the members of its owner.
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
    Result<MemoryPiece> allocate(const MemoryRequest& request);
    Result<MemoryPiece> allocateHooked(const MemoryRequest& request);
    Result<Block> allocateBlock(const MemoryRequest& request, uint32_t type) const;

    const Device* device_;
    VkDeviceSize block_bytes_;
    std::vector<Block> blocks_;
    std::vector<HookedMemory> hooked_;
};

} // namespace hearth::gpu
