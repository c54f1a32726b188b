// The images of a frame and the one render pass over them: visibility, material depth, shading as three subpasses, so
// that on a tile-based GPU the visibility buffer and both depth buffers need not leave the tile.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/draw_layouts.h"

namespace hearth::gpu
{

enum Subpass : uint32_t
{
    kSubpassVisibility = 0,
    kSubpassMaterialDepth = 1,
    kSubpassShading = 2,
};

inline constexpr VkFormat kVisibilityFormat = VK_FORMAT_R32_UINT;
inline constexpr VkFormat kColorFormat = VK_FORMAT_R8G8B8A8_SRGB;

Result<UniqueRenderPass> createFrameRenderPass(const Device& device);

/// After a frame, `visibility` and `color` are in VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, visible to transfers.
/// Before a frame their content and layout do not matter.
class FrameTargets
{
public:
    /// width and height 1 .. the device's limits. errors: device_limit, device_failed.
    static Result<FrameTargets> create(const Device& device, VkRenderPass render_pass,
                                       const DrawLayouts& layouts, VkExtent2D extent);

    VkExtent2D extent() const { return visibility_.extent; }
    const Image& visibility() const { return visibility_; }
    const Image& color() const { return color_; }
    VkFramebuffer framebuffer() const { return framebuffer_.get(); }
    VkDescriptorSet attachments() const { return set_; }
    VkDeviceSize allocatedBytes() const { return arena_.allocatedBytes(); }

private:
    explicit FrameTargets(const Device& device) : arena_(device) {}

    MemoryArena arena_;
    Image visibility_;
    Image depth_;
    Image material_depth_;
    Image color_;
    UniqueFramebuffer framebuffer_;
    UniqueDescriptorPool pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

} // namespace hearth::gpu
