// Marks in the bits of each pixel which of the first kMarkedLights lights of the frame may reach it. A
// forward light stack (M. Billeter, "Many-light rendering on mobile hardware", 2015) by additive blending
// alone, without pixel local storage.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

class MarkLightsPass
{
public:
    /// output  of LightPath::light_bits
    static Result<MarkLightsPass> create(const Device& device, const DrawLayouts& layouts,
                                         const FramePasses& passes, ShadedOutput output);

    /// Record in FrameStep::mark_lights, with viewport and scissor set. Clobbers the graphics state. The
    /// scene has its LitSets.
    void record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                const Scene& scene, const FrameTargets& targets) const;

private:
    UniquePipeline volume_;
};

} // namespace hearth::gpu
