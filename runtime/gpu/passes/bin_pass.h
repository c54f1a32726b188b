// Draws the visible clusters, one indirect draw a bin: into the visibility buffer in the first subpass of the frame; for
// the overdraw view, once more in the last one, where every fragment adds to the picture; or, where they are the casters
// of a shadow map, into that.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"

#include <optional>

namespace hearth::gpu
{

class BinPass
{
public:
    static Result<BinPass> createVisibility(const Device& device, const DrawLayouts& layouts,
                                            VkRenderPass render_pass);
    static Result<BinPass> createOverdraw(const Device& device, const DrawLayouts& layouts,
                                          VkRenderPass render_pass);

    static Result<BinPass> createCasters(const Device& device, const DrawLayouts& layouts,
                                         VkRenderPass render_pass);

    /// The pipelines of deformed bins, which a scene with deformed meshes needs; once. errors: device_failed.
    Status prepareDeformed(const Device& device);

    /// Inside the subpass, with viewport and scissor set. Clobbers the graphics state.
    /// phase  whose clusters are drawn
    /// push   the bin is set for each draw
    void record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                const Scene& scene, uint32_t phase, DrawPush push = {}) const;

private:
    /// For each Facing.
    using Pipelines = UniquePipeline[3];
    struct Stages
    {
        std::span<const uint32_t> vertex, fragment;
    };
    struct Variants
    {
        // [0] for scenes whose geometry lies in one slice of the pool, [1] for all others
        Pipelines opaque[2];
        Pipelines alpha_tested[2];
    };
    Status createPipelines(const Device& device, uint32_t deformed, Variants& variants) const;

    bool casters_ = false; ///< unlit bins are not drawn, all others as Facing::doubleSided
    GraphicsDescription description_{};
    Stages alpha_tested_{};
    Variants rigid_;
    std::optional<Variants> deformed_; ///< once a scene has deformed meshes
};

} // namespace hearth::gpu
