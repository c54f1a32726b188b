// Light statistics: counts the lights that the pixels of a frame evaluate. A separate pass behind a frame
// walks the lists again, so that frames without statistics pay nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/scene.h"

#include <array>

namespace hearth::gpu
{

/// Statistics pass for one scene and targets that keep their visibility buffer; both outlive it.
class LightStatisticsPass
{
public:
    /// errors: device_failed.
    static Result<LightStatisticsPass> create(const Device& device, const DrawLayouts& layouts,
                                              const Scene& scene, const FrameTargets& targets);

    /// Record after a frame of the scene with the targets, before its next one: adds to the counts of the
    /// frame's lists. Clobbers the compute state.
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                const FrameTargets& targets, LightMethod method) const;

private:
    std::array<ComputePipeline, kLightMethodCount> pipelines_;
};

/// Return the counts of the last frame, which has completed.
shared::LightListCounts readLightCounts(const Scene& scene);

} // namespace hearth::gpu
