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
    /// For each Facing.
    using Pipelines = UniquePipeline[3];
    Status createPipelines(const Device& device, const DrawLayouts& layouts, VkRenderPass render_pass,
                           uint32_t used_slices, Pipelines& opaque, Pipelines& alpha_tested);

    // [0] for scenes whose geometry lies in one slice of the pool, [1] for all others
    Pipelines opaque_[2];
    Pipelines alpha_tested_[2];
};

} // namespace hearth::gpu
