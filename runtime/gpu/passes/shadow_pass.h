// Draws the casters of shadow maps, each map into its layer: the clusters that the culling pass found, depth
// only. See runtime/gpu/README.md, "Shadows".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/bin_pass.h"
#include "runtime/gpu/scene/scene_shadows.h"

namespace hearth::gpu
{

class ShadowPass
{
public:
    static Result<ShadowPass> create(const Device& device, const DrawLayouts& layouts, ShadowDepth depth);

    /// Create the pipelines for scenes with deformed meshes; call once.
    Status prepareDeformed(const Device& device) { return casters_.prepareDeformed(device); }

    /// Create the shadow maps of a scene and write them to its descriptor set. Records commands that make the
    /// layers sampleable. errors: same as SceneShadows::create.
    ///
    /// depth  that of the pass
    Status createMaps(const Device& device, const formats::PackView& pack, const ShadowOptions& options,
                      const ShadowDepthChoice& depth, VkCommandBuffer commands, Scene& scene) const;

    /// Record a layer, after the culling pass has found its casters in a view. Outside a render pass. Results
    /// are visible to later fragment shaders and transfers. Clobbers the graphics state.
    void recordMap(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                   const Scene& scene, const SceneView& view, const ShadowCache::LayerUpdate& map) const;

private:
    UniqueRenderPass clear_pass_;
    UniqueRenderPass load_pass_;
    BinPass casters_;
};

} // namespace hearth::gpu
