// Updates the light of the brick faces (GI), a share of them per frame. See runtime/gpu/README.md, "Global
// illumination".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/word_copy_pass.h"
#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

/// Scale of the emission inside a box of the world, relative to the pack.
struct EmissionScale
{
    Box3 box;
    float factor = 1; ///< 0 or more
};

class BrickLightPass
{
public:
    static Result<BrickLightPass> create(const Device& device, const DrawLayouts& layouts);

    /// Record FrameStep::brick_light. Results are visible to later compute and fragment shaders and
    /// transfers.
    ///
    /// copies  of the frame
    /// lights_change  the lights of this frame differ from the last frame's
    /// emission  all scales of this frame: the first shared::kMaxEmissionBoxes count; of overlapping boxes
    ///           the last one
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                const WordCopyPass& copy_words, WordCopies& copies, bool lights_change,
                std::span<const EmissionScale> emission) const;

private:
    ComputePipeline faces_;
};

} // namespace hearth::gpu
