// Draws what follows shading in frames with a final pass: automatic exposure, levels of bloom and their sums,
// the finished image. One triangle each.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/push_constants.h"
#include "runtime/gpu/post/post_settings.h"
#include "runtime/gpu/post/post_targets.h"

namespace hearth::gpu
{

class PostPass
{
public:
    /// The passes have final passes.
    /// shown  what the finished image holds
    static Result<PostPass> create(const Device& device, const DrawLayouts& layouts,
                                   const FramePasses& passes, const StoredColor& shown);

    /// Each records inside its step, with viewport and scissor set. Clobbers the graphics state.
    void recordExposure(const Device& device, VkCommandBuffer commands, const PostTargets& targets,
                        const AutomaticExposure& exposure) const;
    /// level  1 to shared::kBloomLevels
    void recordDown(const Device& device, VkCommandBuffer commands, const PostTargets& targets,
                    uint32_t level) const;
    /// level  1 to shared::kBloomLevels - 1
    void recordUp(const Device& device, VkCommandBuffer commands, const PostTargets& targets,
                  uint32_t level) const;
    /// output      size of the finished image
    /// shows_data  the frame has a debug view: nothing but its size changes
    /// on_tile     the pixel's own value is finished, in the render pass that has made it
    void recordFinal(const Device& device, VkCommandBuffer commands, const PostTargets& targets,
                     const PostSettings& settings, VkExtent2D output, bool shows_data, bool on_tile) const;

private:
    struct Pipeline
    {
        UniquePipelineLayout layout;
        UniquePipeline pipeline;
    };
    template <typename Push>
    static void draw(const Device& device, VkCommandBuffer commands, const Pipeline& pipeline,
                     VkDescriptorSet set, const Push& push);

    Pipeline exposure_, down_, up_;
    Pipeline final_[2][2];   ///< [with bloom][with automatic exposure]
    Pipeline final_on_tile_; ///< of LightPath::surfaces_on_tile, if passes have it
};

} // namespace hearth::gpu
