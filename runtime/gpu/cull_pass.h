// Finds what a frame draws: instances in the frustum, clusters of the cut that may be seen, packed into the visible
// list in a fixed order, and one indirect draw for each bin. See README.md, "Culling".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene.h"

namespace hearth::gpu
{

class CullPass
{
public:
    static Result<CullPass> create(const Device& device);

    /// The descriptor sets of this pass for a scene.
    Status createSets(const Device& device, Scene& scene) const;

    /// Outside a render pass. Waits for earlier frames of the scene on the same queue; what it writes is visible to
    /// indirect draws, vertex and fragment shaders, and transfers that follow. Clobbers the compute state.
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                const shared::FrameView& view) const;

private:
    ComputePipeline instances_;
    ComputePipeline clusters_;
    ComputePipeline scan_blocks_;
    ComputePipeline scan_totals_;
    ComputePipeline emit_visible_;
    ComputePipeline emit_draws_;
};

} // namespace hearth::gpu
