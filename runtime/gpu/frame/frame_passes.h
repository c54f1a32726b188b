// Render passes made from the table of a frame: each has the same two subpasses, the visibility buffer and
// shading, so that all share pipelines and framebuffers. A pass that only fills the visibility buffer, or
// only shades, leaves its other subpass empty.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/frame/frame_description.h"
#include "runtime/gpu/vulkan/device.h"

#include <map>

namespace hearth::gpu
{

enum SubpassNumber : uint32_t
{
    kSubpassVisibility = 0,
    kSubpassShading = 1,
    kSubpassCount,
};

/// Attachments of a framebuffer, in this order.
enum FrameAttachment : uint32_t
{
    kVisibility,
    kDepth,
    kColor,
    kAttachmentCount,
};

inline constexpr VkFormat kVisibilityFormat = VK_FORMAT_R32_UINT;
inline constexpr VkFormat kColorFormat = VK_FORMAT_R8G8B8A8_SRGB;
/// Depth and, with MaterialTest::id, a stencil of the low bits of material numbers.
constexpr VkFormat depthFormat(MaterialTest materials)
{
    return materials == MaterialTest::id ? VK_FORMAT_D32_SFLOAT_S8_UINT : VK_FORMAT_D32_SFLOAT;
}

/// A frame, and its render passes.
struct FramePlan
{
    FrameDescription description;
    std::vector<VkRenderPass> render_passes; ///< [pass]; null for other passes, and for shadow maps
};

/// Plans of all configurations, made before any frame is recorded.
class FramePasses
{
public:
    /// errors: device_failed.
    static Result<FramePasses> create(const Device& device, MaterialTest materials);

    MaterialTest materials() const { return materials_; }
    /// Plan of a configuration; its test of materials and the scene's features do not matter.
    const FramePlan& plan(const FrameConfiguration& configuration) const;
    /// A pass for pipelines and framebuffers, which fit all passes of all plans.
    VkRenderPass anyPass() const { return passes_.begin()->second.get(); }

private:
    /// Load and store operations and layouts of the three attachments.
    using Key = std::vector<uint32_t>;
    Result<VkRenderPass> findOrCreate(const Device& device, const Pass& pass);

    MaterialTest materials_ = MaterialTest::depth;
    std::vector<FramePlan> plans_; ///< configurationIndex
    std::map<Key, UniqueRenderPass> passes_;
};

} // namespace hearth::gpu
