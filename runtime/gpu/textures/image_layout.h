// Layout of a pack's images on the device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"
#include "formats/records/texel_format.h"
#include "runtime/gpu/vulkan/uploader.h"

namespace hearth::gpu
{

/// Return how a view maps stored channels to those that shaders read.
inline VkComponentMapping viewComponents(const formats::ImageRecord& record)
{
    const auto source = [&](uint32_t c) { return static_cast<VkComponentSwizzle>(record.swizzle[c]); };
    return {source(0), source(1), source(2), source(3)};
}

inline TexelBlock blockSize(const formats::TexelFormatTraits& traits)
{
    return {traits.block_bytes, traits.block_width, traits.block_height};
}

} // namespace hearth::gpu
