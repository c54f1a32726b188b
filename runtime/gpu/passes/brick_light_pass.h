// Lights the faces of a scene's bricks, a share of them a frame. See runtime/gpu/README.md, "The light of bricks".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

/// Emission inside a box of the world is `factor` times what the pack says.
struct EmissionScale
{
    Box3 box;
    float factor = 1; ///< from 0
};

class BrickLightPass
{
public:
    static Result<BrickLightPass> create(const Device& device, const DrawLayouts& layouts);

    /// Outside a render pass. What it writes is visible to compute and fragment shaders that follow, and to transfers.
    ///
    /// lights_change  those of the frame are not those of the frame before
    /// emission  all of this frame: the first shared::kMaxEmissionBoxes count, of those that overlap the last
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene, bool lights_change,
                std::span<const EmissionScale> emission) const;

private:
    ComputePipeline faces_;
};

} // namespace hearth::gpu
