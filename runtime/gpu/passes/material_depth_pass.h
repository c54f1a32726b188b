// Writes the material id of each pixel as depth. Second subpass of the frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

class MaterialDepthPass
{
public:
    static Result<MaterialDepthPass> create(const Device& device, const DrawLayouts& layouts,
                                            VkRenderPass render_pass);

    /// Record inside subpass kSubpassMaterialDepth, with viewport and scissor set. Clobbers the graphics
    /// state.
    void record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                const Scene& scene, const FrameTargets& targets) const;

private:
    UniquePipeline pipeline_;
};

} // namespace hearth::gpu
