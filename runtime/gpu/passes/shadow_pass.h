// Draws the casters of shadow maps, each into its layer: what the culling pass found, as depth.
// See runtime/gpu/README.md, "Shadows".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/bin_pass.h"
#include "runtime/gpu/scene/scene_shadows.h"

namespace hearth::gpu
{

class ShadowPass
{
public:
    static Result<ShadowPass> create(const Device& device, const DrawLayouts& layouts);

    /// What scenes with deformed meshes need beside; once.
    Status prepareDeformed(const Device& device) { return casters_.prepareDeformed(device); }

    /// The maps of a scene, and their places in its descriptor set. Records that their layers can be sampled.
    /// errors: those of SceneShadows::create.
    Status createMaps(const Device& device, const formats::PackView& pack, const ShadowOptions& options,
                      VkCommandBuffer commands, Scene& scene) const;

    /// What shaders know of the frame's maps. Outside a render pass, before they are drawn.
    void recordBlock(const Device& device, VkCommandBuffer commands, const Scene& scene) const;

    /// A layer, after the culling pass has found its casters. Outside a render pass; what it writes is visible to fragment
    /// shaders and transfers that follow. Clobbers the graphics state.
    void recordMap(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                   const Scene& scene, const ShadowCache::StaleMap& map) const;

private:
    UniqueRenderPass from_nothing_;
    UniqueRenderPass over_copy_;
    BinPass casters_;
};

} // namespace hearth::gpu
