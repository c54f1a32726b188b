// The render passes of a frame: visibility, material depth, shading as three subpasses, so that on a tile-based GPU the
// visibility buffer and both depth buffers need not leave the tile, or only the visibility buffer where it must.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/device.h"

namespace hearth::gpu
{

enum Subpass : uint32_t
{
    kSubpassVisibility = 0,
    kSubpassMaterialDepth = 1,
    kSubpassShading = 2,
};

enum FrameAttachment : uint32_t
{
    kVisibility,
    kDepth,
    kMaterialDepth,
    kColor,
    kAttachmentCount,
};

inline constexpr VkFormat kVisibilityFormat = VK_FORMAT_R32_UINT;
inline constexpr VkFormat kColorFormat = VK_FORMAT_R8G8B8A8_SRGB;
inline constexpr VkFormat kAttachmentFormats[kAttachmentCount] = {kVisibilityFormat, VK_FORMAT_D32_SFLOAT,
                                                                  VK_FORMAT_D16_UNORM, kColorFormat};

/// With occlusion culling a frame is drawn in two: what the last frame's depth does not hide, then, when the depth
/// of that is known, what was hidden wrongly. With material tiles it ends at the visibility buffer, which a compute
/// pass reads, and the picture is drawn in one more. All are compatible with each other.
struct FramePasses
{
    UniqueRenderPass whole; ///< from nothing to the picture
    UniqueRenderPass early; ///< visibility and depth, stored; the depth can be sampled afterwards
    UniqueRenderPass late;  ///< goes on from there, to the picture

    UniqueRenderPass
        whole_visibility; ///< from nothing to the visibility buffer, which can be sampled afterwards
    UniqueRenderPass late_visibility; ///< from `early` to the same
    UniqueRenderPass picture;         ///< from the visibility buffer to the picture

    static Result<FramePasses> create(const Device& device);
};

} // namespace hearth::gpu
