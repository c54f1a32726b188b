// Render passes of a frame: visibility, material depth and shading as three subpasses. On a tile-based GPU
// the visibility buffer and both depth buffers need not leave the tile, or only the visibility buffer if
// material tiles are used.
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

/// Variants of the frame's render pass; all are compatible with each other. With occlusion culling a frame is
/// drawn in two phases: first the clusters that the last frame's depth does not occlude, then, with the new
/// depth, the clusters that were culled wrongly. With material tiles the render pass ends at the visibility
/// buffer, which a compute pass reads, and another render pass shades.
struct FramePasses
{
    UniqueRenderPass whole; ///< from nothing to the shaded frame
    UniqueRenderPass early; ///< visibility and depth, stored; the depth can be sampled afterwards
    UniqueRenderPass late;  ///< continues after `early`, to the shaded frame

    /// From nothing to the visibility buffer, which can be sampled afterwards.
    UniqueRenderPass whole_visibility;
    UniqueRenderPass late_visibility; ///< continues after `early`, to the visibility buffer
    UniqueRenderPass shading;         ///< from the visibility buffer to the shaded frame

    static Result<FramePasses> create(const Device& device);
};

} // namespace hearth::gpu
