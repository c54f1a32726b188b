// Gathers indirect light (GI) for the visible surfaces: chooses a point in each tile of 8 x 8 pixels, traces
// rays through the bricks, blends with the reprojected history and filters over tiles. See
// runtime/gpu/README.md, "Global illumination".
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

    /// Record outside a render pass, after the visibility buffer, which is in SHADER_READ_ONLY_OPTIMAL and
    /// visible to compute shaders. Results are visible to later fragment shaders and transfers.
    ///
    /// light_changes  the history has a low weight
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                const shared::FrameView& view, bool light_changes) const;

private:
    ComputePipeline points_[2][2]; ///< [pool slices: 1 or all][with deformed meshes]
    ComputePipeline rays_;
    ComputePipeline smooth_;
};

} // namespace hearth::gpu
