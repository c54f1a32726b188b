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
/// has_distances  the same of an image of distances
Result<UniqueRenderPass> createMotionRenderPass(const Device& device, bool has_distances);

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
    /// arena          outlives the targets
    /// has_distances  frames leave distances to the next one
    /// errors: device_failed.
    static Result<MotionTargets> create(const Device& device, MemoryArena& arena, VkExtent2D extent,
                                        bool has_distances);

    const Image& image() const { return image_; }
    bool hasDistances() const { return distances_[0].view.get() != VK_NULL_HANDLE; }
    /// Distances along the view's axis of what pixels show, in this frame and in the one before: metres, at
    /// most shared::kMaxMotionDistance. number: one is of the frame begun last, one of the frame before.
    const Image& distances(uint32_t number) const { return distances_[number]; }
    /// Number of the images of the frame begun last: frames take turns.
    uint32_t number() const { return static_cast<uint32_t>(frame_ % 2); }
    VkFramebuffer framebuffer() const { return framebuffers_[hasDistances() ? number() : 0].get(); }

    /// Begin a frame in a step of the scene (SceneTables::step).
    void beginFrame(const shared::FrameView& view, uint64_t step);
    /// Step of the frame begun last; 0: there is none.
    uint64_t step() const { return step_; }
    /// View of the frame begun last, and of the one before it.
    const shared::FrameView& view() const { return view_; }
    const std::optional<shared::FrameView>& earlierView() const { return earlier_view_; }
    /// Frames begun.
    uint64_t frame() const { return frame_; }

private:
    MotionTargets() = default;

    Status createFramebuffers(const Device& device, VkExtent2D extent);

    Image image_;
    Image distances_[2];
    UniqueRenderPass render_pass_;      ///< that framebuffers were made for; MotionPass has a compatible one
    UniqueFramebuffer framebuffers_[2]; ///< the second with distances
    uint64_t frame_ = 0;
    shared::FrameView view_{};
    std::optional<shared::FrameView> earlier_view_;
    uint64_t step_ = 0;
};

} // namespace hearth::gpu
