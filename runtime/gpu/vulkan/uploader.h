// Uploads data to the device: writes into mapped staging memory now, and records copies that the caller
// submits.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/memory.h"

namespace hearth::gpu
{

/// Unit of an image's data.
struct TexelBlock
{
    uint32_t bytes;
    uint32_t width = 1; ///< texels
    uint32_t height = 1;
};

/// Owns the staging memory of one upload; must live until the recorded commands have run.
class Uploader
{
public:
    Uploader(const Device& device, VkCommandBuffer commands)
        : device_(device), commands_(commands), arena_(device)
    {
    }

    /// Return mapped memory of `size` > 0 bytes that is copied to the start of `target`.
    Result<std::span<std::byte>> stage(const Buffer& target, VkDeviceSize size);

    /// Copy the bytes to the start of `target`; nothing if empty.
    Status upload(const Buffer& target, std::span<const std::byte> bytes);

    /// Upload a contiguous range of records.
    template <typename Range>
    Status uploadRecords(const Buffer& target, const Range& records)
    {
        return upload(target, std::as_bytes(std::span(records)));
    }

    /// Upload all mips of an image, finest first, each with all of its layers, tightly packed, in whole
    /// blocks; leaves it readable by shaders.
    Status upload(const Image& target, std::span<const std::byte> texels, const TexelBlock& block);

    /// Make all copies visible to later commands.
    void finish();

private:
    const Device& device_;
    VkCommandBuffer commands_;
    MemoryArena arena_;
    std::vector<Buffer> buffers_;
};

} // namespace hearth::gpu
