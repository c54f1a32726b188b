// Temporal anti-aliasing: filters frames whose views are shifted by parts of a pixel. A separate pass behind
// the motion vectors of a frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"

namespace hearth::gpu
{

/// Shifts of the view after which jitterShift repeats: as many frames as the mean of a pixel at rest has.
inline constexpr uint32_t kJitterFrames = 32;

/// Return the shift of frame `number` (Camera::shift), up to half a pixel each way: Halton's sequence of
/// bases 2 and 3. J. H. Halton, "On the efficiency of certain quasi-random sequences of points", 1960.
/// extent  pixels of the frame
Float2 jitterShift(uint32_t number, VkExtent2D extent);

class TemporalPass
{
public:
    /// errors: device_failed.
    static Result<TemporalPass> create(const Device& device, const DrawLayouts& layouts);

    /// Record after MotionPass of a frame with the targets: draws TemporalTargets::filtered. The frame before
    /// with the targets counts if it was filtered, too. Leaves the shaded frame in
    /// VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL. Outside a render pass. Clobbers the graphics state.
    /// targets  with TargetOptions::has_temporal_filter (asserted)
    /// resets   leave earlier frames out, as after a cut: the frame stays as it is
    void record(const Device& device, VkCommandBuffer commands, FrameTargets& targets, bool resets) const;

private:
    UniqueRenderPass render_pass_;
    UniquePipelineLayout layout_;
    UniquePipeline pipeline_;
};

} // namespace hearth::gpu
