// Reduces the depth buffer to the pyramid that occlusion culling looks at (formats/gpu_shared/occlusion.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"

namespace hearth::gpu
{

class PyramidPass
{
public:
    static Result<PyramidPass> create(const Device& device, const DrawLayouts& layouts);

    /// Outside a render pass, behind the early one. What it writes is visible to compute shaders that follow, and to
    /// transfers.
    void record(const Device& device, VkCommandBuffer commands, const FrameTargets& targets) const;

private:
    ComputePipeline tiles_;
    ComputePipeline top_;
};

} // namespace hearth::gpu
