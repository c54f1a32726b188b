// Draws the visible clusters into the visibility buffer: one indirect draw a bin. First subpass of the frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene.h"

namespace hearth::gpu
{

class VisibilityPass
{
public:
    static Result<VisibilityPass> create(const Device& device, const DrawLayouts& layouts,
                                         VkRenderPass render_pass);

    /// Inside subpass kSubpassVisibility, with viewport and scissor set. Clobbers the graphics state.
    void record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                const Scene& scene) const;

private:
    // for each Facing
    UniquePipeline opaque_[3];
    UniquePipeline alpha_tested_[3];
};

} // namespace hearth::gpu
