// Finds what a frame draws: instances in the frustum, clusters of the cut that may be seen, packed into the visible
// list in a fixed order, and one indirect draw for each bin. With occlusion culling in two phases. See runtime/gpu/README.md,
// "Culling".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/instance_motion.h"
#include "runtime/gpu/scene/light_change.h"
#include "runtime/gpu/scene/scene.h"

#include <optional>

namespace hearth::gpu
{

class CullPass
{
public:
    static Result<CullPass> create(const Device& device, const DrawLayouts& layouts);

    /// What scenes with deformed meshes need beside; once.
    Status prepareDeformed(const Device& device, const DrawLayouts& layouts);

    /// The descriptor sets of this pass for a scene.
    Status createSets(const Device& device, Scene& scene) const;

    /// The frame's constants, what moves and changes, and what streaming brought. Outside a render pass; waits for earlier frames of
    /// the scene on the same queue.
    void recordConstants(const Device& device, VkCommandBuffer commands, const Scene& scene,
                         const FrameTargets& targets, const shared::FrameView& view,
                         std::span<const InstanceMove> moves, std::span<const InstancePose> poses,
                         std::span<const LightChange> lights = {}) const;

    /// The same frame from elsewhere: other constants, and cleared counters. After recordConstants.
    void recordView(const Device& device, VkCommandBuffer commands, const Scene& scene,
                    const FrameTargets& targets, const shared::FrameView& view) const;

    /// kPhaseWhole; or kPhaseEarly, and when its clusters are drawn and the pyramid is made, kPhaseLate, which adds
    /// draws and adds to the list. Outside a render pass; what it writes is visible to indirect draws, vertex and
    /// fragment shaders, and transfers that follow. Clobbers the compute state.
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                const FrameTargets& targets, uint32_t phase) const;

private:
    ComputePipeline instances_;
    ComputePipeline clusters_;
    std::optional<ComputePipeline> deformed_clusters_; ///< once a scene has them
    ComputePipeline scan_blocks_;
    ComputePipeline scan_totals_;
    ComputePipeline emit_visible_;
    ComputePipeline emit_draws_;
};

} // namespace hearth::gpu
