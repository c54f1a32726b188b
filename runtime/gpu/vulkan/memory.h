// Device memory in large blocks, and the buffers and images bound to it.
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
    std::byte* mapped = nullptr; ///< of mapped kinds of memory
};

struct Image
{
    UniqueImage handle;
    UniqueImageView view;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};
    uint32_t mip_count = 1;
    uint32_t layer_count = 1;
    VkDeviceSize bytes = 0; ///< that the device needs for it
};

struct ImageDescription
{
    VkFormat format;
    VkExtent2D extent;
    uint32_t mip_count = 1;
    VkImageUsageFlags usage;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    uint32_t array_layers = 0;            ///< 0: not an array
    bool is_cube = false;                 ///< six square panels; not an array
    bool has_views = false;               ///< createView makes views with other formats
    MemoryKind kind = MemoryKind::device; ///< or transient, with usage TRANSIENT_ATTACHMENT
    VkComponentMapping components{};      ///< of the view
};

/// Return the number of layers of an image.
constexpr uint32_t countLayers(const ImageDescription& description)
{
    return description.is_cube ? 6 : std::max(description.array_layers, 1u);
}

/// Create a view of an image with ImageDescription::has_views, of one mip and layer, in another format of as
/// many bits.
/// usage  of the view: some of the image's
/// errors: device_failed.
Result<UniqueImageView> createView(const Device& device, const Image& image, VkFormat format,
                                   VkImageUsageFlags usage);

/// Return the bytes that the device needs for an image. errors: device_failed.
Result<VkDeviceSize> measureImage(const Device& device, const ImageDescription& description);

/// Allocation from MemoryHooks, freed on destruction.
class HookAllocation
{
public:
    HookAllocation(const MemoryHooks& hooks, const MemoryAllocation& piece, VkDeviceSize size)
        : hooks_(&hooks), piece_(piece), size_(size)
    {
    }
    HookAllocation(HookAllocation&& other) noexcept
        : hooks_(std::exchange(other.hooks_, nullptr)), piece_(other.piece_), size_(other.size_)
    {
    }
    HookAllocation& operator=(HookAllocation&& other) noexcept
    {
        std::swap(hooks_, other.hooks_);
        std::swap(piece_, other.piece_);
        std::swap(size_, other.size_);
        return *this;
    }
    ~HookAllocation()
    {
        if (hooks_ != nullptr)
            hooks_->free(hooks_->user, piece_);
    }

    VkDeviceSize size() const { return size_; }

private:
    const MemoryHooks* hooks_;
    MemoryAllocation piece_;
    VkDeviceSize size_;
};

/// Arena allocator over blocks, or over the caller's hooks if set. Frees nothing before its own destruction.
/// Buffers and images of an arena must be destroyed before it, so it is the first member of its owner.
class MemoryArena
{
public:
    /// block_bytes  size of a device allocation: large enough to stay below the smallest
    ///              maxMemoryAllocationCount (4096), small enough not to waste a phone's memory; 0 for an
    ///              arena that holds one resource
    explicit MemoryArena(const Device& device, VkDeviceSize block_bytes = VkDeviceSize{16} << 20)
        : device_(&device), block_bytes_(block_bytes)
    {
    }

    /// Create a buffer of at least one byte. errors: device_failed.
    Result<Buffer> createBuffer(VkDeviceSize size, VkBufferUsageFlags usage, MemoryKind kind);
    /// Create a 2D image, or an array, with a view of all mips and layers. errors: device_failed.
    Result<Image> createImage(const ImageDescription& description);

    /// Bytes allocated, without those that the device allocates lazily.
    VkDeviceSize allocatedBytes() const;
    /// Bytes of memory that the device allocates lazily, if ever.
    VkDeviceSize transientBytes() const { return transient_bytes_; }

private:
    struct Block
    {
        UniqueMemory memory;
        uint32_t type = 0;
        bool images = false; // separate blocks for buffers and images avoid bufferImageGranularity
        VkDeviceSize size = 0;
        VkDeviceSize used = 0;
        std::byte* mapped = nullptr;
    };
    Result<MemoryAllocation> allocate(const MemoryRequest& request);
    Result<MemoryAllocation> allocateHooked(const MemoryRequest& request);
    Result<Block> allocateBlock(const MemoryRequest& request, uint32_t type) const;

    const Device* device_;
    VkDeviceSize block_bytes_;
    std::vector<Block> blocks_;
    std::vector<HookAllocation> hooked_;
    VkDeviceSize transient_bytes_ = 0;
};

} // namespace hearth::gpu
