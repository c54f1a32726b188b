// Image of the motion vectors of a camera, and its view of the frame before.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/records.h"
#include "runtime/gpu/vulkan/memory.h"

#include <optional>

namespace hearth::gpu
{

/// Create the render pass that draws motion vectors: all of an image, which is then in kMotionLayout, visible
/// to fragment and compute shaders and to copies. errors: device_failed.
Result<UniqueRenderPass> createMotionRenderPass(const Device& device);

inline constexpr VkFormat kMotionFormat = VK_FORMAT_R16G16_SFLOAT;
inline constexpr VkImageLayout kMotionLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
inline constexpr VkPipelineStageFlags kMotionReaders = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT |
                                                       VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT |
                                                       VK_PIPELINE_STAGE_TRANSFER_BIT;
inline constexpr VkAccessFlags kMotionReads = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT;

/// Part of FrameTargets.
class MotionTargets
{
public:
    /// arena  outlives the targets
    /// errors: device_failed.
    static Result<MotionTargets> create(const Device& device, MemoryArena& arena, VkExtent2D extent);

    const Image& image() const { return image_; }
    VkFramebuffer framebuffer() const { return framebuffer_.get(); }

    /// Begin a frame in a step of the scene (SceneTables::step).
    void beginFrame(const shared::FrameView& view, uint64_t step);
    /// Step of the frame begun last; 0: there is none.
    uint64_t step() const { return step_; }
    /// View of the frame begun last, and of the one before it.
    const shared::FrameView& view() const { return view_; }
    const std::optional<shared::FrameView>& earlierView() const { return earlier_view_; }

private:
    MotionTargets() = default;

    Image image_;
    UniqueRenderPass render_pass_; ///< that the framebuffer was made for; MotionPass has a compatible one
    UniqueFramebuffer framebuffer_;
    shared::FrameView view_{};
    std::optional<shared::FrameView> earlier_view_;
    uint64_t step_ = 0;
};

} // namespace hearth::gpu
