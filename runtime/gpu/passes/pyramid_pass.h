// Reduces the depth buffer to the depth pyramid of occlusion culling (formats/gpu_shared/occlusion.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"

namespace hearth::gpu
{

class PyramidPass
{
public:
    static Result<PyramidPass> create(const Device& device, const DrawLayouts& layouts);

    /// Record outside a render pass: fill the pyramid of an occlusion set of the targets with their depth.
    /// Results are visible to later compute shaders and transfers.
    void record(const Device& device, VkCommandBuffer commands, const FrameTargets& targets,
                VkDescriptorSet set) const;

private:
    ComputePipeline tiles_;
    ComputePipeline top_;
};

} // namespace hearth::gpu
