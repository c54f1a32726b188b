// Motion vectors: finds where what the pixels of a frame show was in the frame before. A separate pass behind
// a frame, so that frames without them pay nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

/// Motion pass for one scene, which has SceneOptions::keeps_motion.
class MotionPass
{
public:
    /// errors: device_failed.
    static Result<MotionPass> create(const Device& device, const DrawLayouts& layouts, const Scene& scene);

    /// Record after a frame of the scene with the targets, before the scene's next one: draws
    /// MotionTargets::image, and leaves it in kMotionLayout. A pixel gets the place in the frame before of
    /// what it shows, less its own: in pixels, to the right and downwards, with both shifts of the view's
    /// axis (Camera::shift) left out. What was behind the eye gets shared::kMotionUnseen twice, everything in
    /// the first frame of the targets 0. Draws MotionTargets::distances, too, if there are any. Outside a
    /// render pass. Clobbers the graphics state.
    /// targets  with TargetOptions::has_motion (asserted)
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                const FrameTargets& targets) const;

private:
    UniquePipelineLayout layout_;
    UniqueRenderPass render_passes_[2]; ///< [with distances]; as the next one
    UniquePipeline pipelines_[2];
};

} // namespace hearth::gpu
