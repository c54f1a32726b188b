// Draws the visible clusters, one indirect draw per bin: into the visibility buffer; for the overdraw view
// once more into the shaded frame, where every fragment is added to the image; shadow casters into a map.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/frame/frame_passes.h"
#include "runtime/gpu/scene/scene.h"

#include <map>
#include <optional>

namespace hearth::gpu
{

class BinPass
{
public:
    static Result<BinPass> createVisibility(const Device& device, const DrawLayouts& layouts,
                                            const DrawPlace& place);
    static Result<BinPass> createOverdraw(const Device& device, const DrawLayouts& layouts,
                                          const DrawPlace& place);

    static Result<BinPass> createCasters(const Device& device, const DrawLayouts& layouts,
                                         VkRenderPass render_pass);

    /// Create the pipelines of deformed bins, which a scene with deformed meshes needs; call once. errors:
    /// device_failed.
    Status prepareDeformed(const Device& device);

    /// Create the pipelines of bins whose material has a motion of the game, unless they exist. errors: usage
    /// if the game has not compiled it; device_failed.
    Status prepareMotion(const Device& device, const MaterialShaders& shaders, uint32_t motion);

    /// Record inside the subpass, with viewport and scissor set. Clobbers the graphics state.
    /// view   culled view of the scene's frame
    /// phase  culling phase whose clusters are drawn
    /// push   the bin is set for each draw
    void record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                const Scene& scene, const SceneView& view, uint32_t phase, shared::BinPush push = {}) const;

private:
    /// One pipeline per Facing.
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
    Status createPipelines(const Device& device, DrawConstants constants, std::span<const uint32_t> vertex,
                           std::span<const uint32_t> tested_vertex, Variants& variants) const;
    const Variants& findVariants(const SceneBin& bin) const;

    bool casters_ = false; ///< unlit bins are not drawn, all others as Facing::doubleSided
    GraphicsDescription description_{};
    Stages alpha_tested_{};
    Variants rigid_;
    std::optional<Variants> deformed_;     ///< set once a scene has deformed meshes
    std::map<uint32_t, Variants> motions_; ///< by MaterialBinding::motion
};

} // namespace hearth::gpu
