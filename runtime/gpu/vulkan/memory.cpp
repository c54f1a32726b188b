// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/memory.h"

#include <algorithm>
#include <optional>

namespace hearth::gpu
{

namespace
{

constexpr VkMemoryPropertyFlags kMapped =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

std::optional<uint32_t> findType(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed,
                                 VkMemoryPropertyFlags wanted)
{
    for (uint32_t type = 0; type < memory.memoryTypeCount; ++type)
        if ((allowed >> type & 1) != 0 && (memory.memoryTypes[type].propertyFlags & wanted) == wanted)
            return type;
    return std::nullopt;
}

/// Choose the best memory type available: each kind has preferred properties that it can do without.
std::optional<uint32_t> chooseType(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed,
                                   MemoryKind kind)
{
    VkMemoryPropertyFlags best = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    VkMemoryPropertyFlags enough = 0;
    if (kind == MemoryKind::transient)
    {
        best = VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT;
        enough = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    }
    if (kind == MemoryKind::staging)
        best = enough = kMapped;
    if (kind == MemoryKind::upload)
    {
        best = kMapped | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
        enough = kMapped;
    }
    if (kind == MemoryKind::readback)
    {
        best = kMapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
        enough = kMapped;
    }
    const auto type = findType(memory, allowed, best);
    return type ? type : findType(memory, allowed, enough);
}

bool isMapped(MemoryKind kind)
{
    return kind == MemoryKind::staging || kind == MemoryKind::readback || kind == MemoryKind::upload;
}

VkDeviceSize alignUp(VkDeviceSize value, VkDeviceSize alignment)
{
    return (value + alignment - 1) / alignment * alignment;
}

VkImageViewType viewType(const ImageDescription& description)
{
    if (description.is_cube)
        return VK_IMAGE_VIEW_TYPE_CUBE;
    return description.array_layers > 0 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
}

/// Create an image without memory.
Result<UniqueImage> createUnbound(const Device& device, const ImageDescription& description)
{
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = description.format;
    info.extent = {description.extent.width, description.extent.height, 1};
    info.mipLevels = description.mip_count;
    info.arrayLayers = countLayers(description);
    if (description.is_cube)
        info.flags |= VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
    if (description.has_views)
        info.flags |= VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = description.usage;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImage handle;
    HEARTH_TRY_VK(device.vk.vkCreateImage(device.handle, &info, device.allocator, &handle),
                  "create an image");
    return UniqueImage(device, handle);
}

} // namespace

Result<UniqueImageView> createView(const Device& device, const Image& image, VkFormat format,
                                   VkImageUsageFlags usage)
{
    const VkImageViewUsageCreateInfo usage_info{VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO, nullptr,
                                                usage};
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.pNext = &usage_info; // the format may not support all usages of the image
    info.image = image.handle.get();
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkImageView view;
    HEARTH_TRY_VK(device.vk.vkCreateImageView(device.handle, &info, device.allocator, &view),
                  "create an image view");
    return UniqueImageView(device, view);
}

Result<VkDeviceSize> measureImage(const Device& device, const ImageDescription& description)
{
    HEARTH_ASSIGN_OR_RETURN(const UniqueImage image, createUnbound(device, description));
    VkMemoryRequirements needs;
    device.vk.vkGetImageMemoryRequirements(device.handle, image.get(), &needs);
    return needs.size;
}

Result<MemoryAllocation> MemoryArena::allocateHooked(const MemoryRequest& request)
{
    const MemoryHooks& hooks = device_->memory_hooks;
    MemoryAllocation piece;
    HEARTH_TRY_VK(hooks.allocate(hooks.user, request, piece), "allocate device memory");
    HookAllocation allocation(hooks, piece, request.needs.size);
    hooked_.push_back(std::move(allocation)); // which frees it if that throws
    if (isMapped(request.kind) && piece.mapped == nullptr)
        return vulkanError(VK_ERROR_MEMORY_MAP_FAILED, "map device memory");
    return piece;
}

Result<MemoryArena::Block> MemoryArena::allocateBlock(const MemoryRequest& request, uint32_t type) const
{
    Block block;
    block.type = type;
    block.images = request.image;
    block.size = std::max(block_bytes_, request.needs.size);
    const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, block.size, type};
    VkDeviceMemory memory;
    HEARTH_TRY_VK(device_->vk.vkAllocateMemory(device_->handle, &info, device_->allocator, &memory),
                  "allocate device memory");
    block.memory = UniqueMemory(*device_, memory);
    if (isMapped(request.kind))
    {
        void* mapped = nullptr;
        HEARTH_TRY_VK(device_->vk.vkMapMemory(device_->handle, memory, 0, VK_WHOLE_SIZE, 0, &mapped),
                      "map device memory");
        block.mapped = static_cast<std::byte*>(mapped);
    }
    return block;
}

Result<MemoryAllocation> MemoryArena::allocate(const MemoryRequest& request)
{
    const VkMemoryRequirements& needs = request.needs;
    const auto type = chooseType(device_->memory, needs.memoryTypeBits, request.kind);
    if (type &&
        (device_->memory.memoryTypes[*type].propertyFlags & VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT) != 0)
        transient_bytes_ += needs.size;
    if (device_->memory_hooks.allocate != nullptr)
        return allocateHooked(request);
    if (!type)
        return vulkanError(VK_ERROR_OUT_OF_DEVICE_MEMORY, "find a fitting memory type");

    Block* block = nullptr;
    for (Block& b : blocks_)
        if (b.type == *type && b.images == request.image && (b.mapped != nullptr) == isMapped(request.kind) &&
            alignUp(b.used, needs.alignment) + needs.size <= b.size)
            block = &b;
    if (block == nullptr)
    {
        HEARTH_ASSIGN_OR_RETURN(Block fresh, allocateBlock(request, *type));
        blocks_.push_back(std::move(fresh));
        block = &blocks_.back();
    }
    const VkDeviceSize offset = alignUp(block->used, needs.alignment);
    block->used = offset + needs.size;
    return MemoryAllocation{.memory = block->memory.get(),
                            .offset = offset,
                            .mapped = block->mapped == nullptr ? nullptr : block->mapped + offset};
}

Result<Buffer> MemoryArena::createBuffer(VkDeviceSize size, VkBufferUsageFlags usage, MemoryKind kind)
{
    Buffer buffer;
    buffer.size = std::max<VkDeviceSize>(alignUp(size, 16), 16);
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = buffer.size;
    info.usage = usage;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    VkBuffer handle;
    HEARTH_TRY_VK(device_->vk.vkCreateBuffer(device_->handle, &info, device_->allocator, &handle),
                  "create a buffer");
    buffer.handle = UniqueBuffer(*device_, handle);

    VkMemoryRequirements needs;
    device_->vk.vkGetBufferMemoryRequirements(device_->handle, handle, &needs);
    HEARTH_ASSIGN_OR_RETURN(const MemoryAllocation piece, allocate({needs, kind, false}));
    HEARTH_TRY_VK(device_->vk.vkBindBufferMemory(device_->handle, handle, piece.memory, piece.offset),
                  "bind a buffer's memory");
    buffer.mapped = piece.mapped;
    return buffer;
}

Result<Image> MemoryArena::createImage(const ImageDescription& description)
{
    Image image;
    HEARTH_ASSIGN_OR_RETURN(image.handle, createUnbound(*device_, description));
    const VkImage handle = image.handle.get();
    image.format = description.format;
    image.extent = description.extent;
    image.mip_count = description.mip_count;
    image.layer_count = countLayers(description);

    VkMemoryRequirements needs;
    device_->vk.vkGetImageMemoryRequirements(device_->handle, handle, &needs);
    image.bytes = needs.size;
    HEARTH_ASSIGN_OR_RETURN(const MemoryAllocation piece, allocate({needs, description.kind, true}));
    HEARTH_TRY_VK(device_->vk.vkBindImageMemory(device_->handle, handle, piece.memory, piece.offset),
                  "bind an image's memory");

    VkImageViewCreateInfo view_info{};
    view_info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view_info.image = handle;
    view_info.viewType = viewType(description);
    view_info.format = description.format;
    view_info.components = description.components;
    view_info.subresourceRange = {description.aspect, 0, description.mip_count, 0, countLayers(description)};
    VkImageView view;
    HEARTH_TRY_VK(device_->vk.vkCreateImageView(device_->handle, &view_info, device_->allocator, &view),
                  "create an image view");
    image.view = UniqueImageView(*device_, view);
    return image;
}

VkDeviceSize MemoryArena::allocatedBytes() const
{
    VkDeviceSize bytes = 0;
    for (const Block& block : blocks_)
        bytes += block.size;
    for (const HookAllocation& memory : hooked_)
        bytes += memory.size();
    return bytes - std::min(bytes, transient_bytes_);
}

} // namespace hearth::gpu
