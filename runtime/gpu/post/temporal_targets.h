// Images of the temporal filter: the filtered frame, and the mean of frames that is left to the next one.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/post/motion_targets.h"
#include "runtime/gpu/scene/draw_layouts.h"

namespace hearth::gpu
{

/// Readers of the filtered frame, and of the history, which are fragments.
inline constexpr VkPipelineStageFlags kFilterReaders =
    VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
inline constexpr VkAccessFlags kFilterReads = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT;

/// Create the render pass of the filter: it draws all of the filtered frame, which is then in
/// VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, visible to kFilterReaders, and the history. errors: device_failed.
Result<UniqueRenderPass> createTemporalRenderPass(const Device& device);

/// Part of FrameTargets.
class TemporalTargets
{
public:
    /// arena   outlives the targets
    /// motion  of the same targets, with distances
    /// color   the shaded frame
    /// errors: device_failed.
    static Result<TemporalTargets> create(const Device& device, const DrawLayouts& layouts,
                                          MemoryArena& arena, const MotionTargets& motion,
                                          const Image& color);

    /// R8G8B8A8_SRGB, as the shaded frame.
    const Image& filtered() const { return filtered_; }
    /// Mean of frames, linear, and how many they are (alpha). number: as MotionTargets::number.
    const Image& history(uint32_t number) const { return history_[number]; }

    /// Set and framebuffer of a frame with that MotionTargets::number.
    VkDescriptorSet set(uint32_t number) const { return sets_[number]; }
    VkFramebuffer framebuffer(uint32_t number) const { return framebuffers_[number].get(); }

    /// Begin a filtered frame, whose number counts on (MotionTargets::frame). True if the frame before was
    /// filtered, too: its history is there. Records the first layouts of images that no frame has drawn to.
    bool beginFrame(const Device& device, VkCommandBuffer commands, const MotionTargets& motion);

private:
    TemporalTargets() = default;
    Status createFramebuffers(const Device& device);
    Status createSets(const Device& device, const DrawLayouts& layouts, const MotionTargets& motion,
                      const Image& color);

    Image filtered_;
    Image history_[2];
    UniqueRenderPass render_pass_; ///< that framebuffers were made for; TemporalPass has a compatible one
    UniqueFramebuffer framebuffers_[2];
    UniqueSampler texels_, between_texels_;
    UniqueDescriptorPool pool_;
    VkDescriptorSet sets_[2] = {};
    uint64_t frame_ = 0; ///< filtered last; 0: none
};

} // namespace hearth::gpu
