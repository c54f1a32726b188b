// Draws the casters of shadow maps, each map into its layer: the clusters and proxies that the culling pass
// found, depth only. See runtime/gpu/README.md, "Shadows".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/bin_pass.h"
#include "runtime/gpu/scene/scene_shadows.h"

namespace hearth::gpu
{

class ShadowPass
{
public:
    /// render_pass  FramePasses::shadowMapPass of the format
    static Result<ShadowPass> create(const Device& device, const DrawLayouts& layouts,
                                     VkRenderPass render_pass);

    /// Create the pipelines for scenes with deformed meshes; call once.
    Status prepareDeformed(const Device& device) { return casters_.prepareDeformed(device); }

    /// As BinPass::prepareMotion.
    Status prepareMotion(const Device& device, const MaterialShaders& shaders, uint32_t motion)
    {
        return casters_.prepareMotion(device, shaders, motion);
    }

    /// Create the pipeline for scenes whose proxies cast shadows; call once.
    Status prepareProxies(const Device& device);

    /// Create the shadow maps of a scene and write them to its descriptor set. Records commands that make the
    /// layers sampleable. errors: same as SceneShadows::create.
    ///
    /// depth  that of the pass
    Status createMaps(const Device& device, const formats::PackView& pack, const ShadowOptions& options,
                      const ShadowDepthChoice& depth, VkCommandBuffer commands, Scene& scene) const;

    /// Record, in FrameStep::shadow_cull, copies of the counters of maps, after their casters were found.
    ///
    /// views  of the maps
    void recordCounters(const Device& device, VkCommandBuffer commands, const Scene& scene,
                        std::span<const SceneView> views,
                        std::span<const ShadowCache::LayerUpdate> maps) const;

    /// Record FrameStep::shadow_copy of a map. Leaves its layer in TRANSFER_DST_OPTIMAL.
    void recordCopy(const Device& device, VkCommandBuffer commands, const Scene& scene,
                    const ShadowCache::LayerUpdate& map) const;

    /// Record the draws of a map into its layer, in a render pass. Clobbers the graphics state.
    void recordMap(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                   const Scene& scene, const SceneView& view, const ShadowCache::LayerUpdate& map) const;

private:
    /// Pipeline that draws proxies.
    struct Proxies
    {
        UniqueSetLayout set_layout;
        UniquePipelineLayout layout;
        UniquePipeline pipeline;
    };
    Status createProxySets(const Device& device, Scene& scene) const;
    void recordProxies(const Device& device, VkCommandBuffer commands, const SceneView& view,
                       const shared::BinPush& push) const;

    VkRenderPass render_pass_ = VK_NULL_HANDLE;
    BinPass casters_;
    std::optional<Proxies> proxies_; ///< set once proxies of a scene cast shadows
};

} // namespace hearth::gpu
