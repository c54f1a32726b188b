// GPU culling: instances by the frustum, clusters by the LOD cut, frustum, normal cones and occlusion. Packs
// the survivors into the visible list in a deterministic order and writes one indirect draw per bin. With
// occlusion culling in two phases. See runtime/gpu/README.md, "Culling".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/scene.h"

#include <optional>

namespace hearth::gpu
{

class CullPass
{
public:
    static Result<CullPass> create(const Device& device, const DrawLayouts& layouts);

    /// Create the pipelines for scenes with deformed meshes; call once.
    Status prepareDeformed(const Device& device, const DrawLayouts& layouts);

    /// Create the pipeline for scenes whose proxies cast shadows; call once.
    Status prepareProxies(const Device& device);

    /// Allocate the descriptor sets of this pass for the views of a scene.
    Status createSets(const Device& device, Scene& scene) const;

    /// Record one culling phase: kPhaseWhole; or kPhaseEarly, then, after its clusters are drawn and the
    /// pyramid is built, kPhaseLate, which appends to the visible list and adds draws. Outside a render pass.
    /// Results are visible to later compute shaders and transfers. Clobbers the compute state.
    ///
    /// view  of the scene's frame; its constants are written, its draws of materials and proxies are empty
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene, const SceneView& view,
                VkDescriptorSet occlusion, uint32_t phase) const;

private:
    Status createViewSets(const Device& device, const Scene& scene, uint32_t frame, SceneView& view) const;

    ComputePipeline instances_;
    ComputePipeline clusters_;
    std::optional<ComputePipeline> deformed_clusters_; ///< set once a scene has deformed meshes
    std::optional<ComputePipeline> list_proxies_;      ///< set once proxies of a scene cast shadows
    ComputePipeline scan_blocks_;
    ComputePipeline scan_totals_;
    ComputePipeline emit_visible_;
    ComputePipeline emit_draws_;
};

} // namespace hearth::gpu
