// Picking: finds the triangles that pixels of a frame show. A separate pass behind a frame, so that frames
// without picks pay nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/queries/picks.h"
#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/scene.h"

#include <vector>

namespace hearth::gpu
{

/// Pick pass for one scene, which outlives it.
class PickPass
{
public:
    /// errors: device_failed.
    static Result<PickPass> create(const Device& device, const DrawLayouts& layouts, const Scene& scene);

    /// Record after a frame of the scene with the targets, before the scene's next one: a copy of a
    /// shared::Pick for each pixel of a rectangle, row by row from the top, visible to the host. Outside a
    /// render pass. Clobbers the compute state.
    /// targets      that keep their visibility buffer (asserted)
    /// pixels       inside of the targets; at most shared::kMaxPicks
    /// destination  with the usage TRANSFER_DST
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                const FrameTargets& targets, VkRect2D pixels, VkBuffer destination,
                VkDeviceSize offset) const;

    VkDeviceSize allocatedBytes() const { return arena_.allocatedBytes(); }

private:
    explicit PickPass(const Device& device) : arena_(device, 0) {}

    MemoryArena arena_;
    Buffer picks_;
    UniqueDescriptorPool pool_;
    ComputePipeline pipeline_;
    std::vector<VkDescriptorSet> sets_; ///< for each frame in flight
};

} // namespace hearth::gpu
