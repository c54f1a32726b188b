// Gathers the light of bricks for the surfaces of a picture: finds a point in each tile of 8 x 8 pixels, sends rays from it,
// goes on with what the frame before found there, and smooths over tiles. See runtime/gpu/README.md, "The light of bricks".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

class GatherPass
{
public:
    static Result<GatherPass> create(const Device& device, const DrawLayouts& layouts);

    /// Outside a render pass, behind the visibility buffer, which is in SHADER_READ_ONLY_OPTIMAL and visible to compute
    /// shaders. What it writes is visible to fragment shaders that follow, and to transfers.
    ///
    /// light_changes  what was found before counts less
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                const shared::FrameView& view, bool light_changes) const;

private:
    ComputePipeline points_[2][2]; ///< [slices of the geometry pool: 1 or all][with deformed meshes]
    ComputePipeline rays_;
    ComputePipeline smooth_;
};

} // namespace hearth::gpu
