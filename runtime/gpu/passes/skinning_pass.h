// Skins the visible deformed clusters of a frame once, before they are drawn and shaded, as many as the
// scratch buffer holds. See runtime/gpu/README.md, "Characters".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

class SkinningPass
{
public:
    static Result<SkinningPass> create(const Device& device, const DrawLayouts& layouts);

    /// Allocate the descriptor sets of this pass for a scene with deformed meshes.
    Status createSets(const Device& device, Scene& scene) const;

    /// Record after CullPass::record of the same phase. Outside a render pass. Results are visible to later
    /// compute shaders and transfers. Clobbers the compute state.
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene, uint32_t phase) const;

private:
    ComputePipeline plan_;
    // [0] for scenes whose geometry lies in one slice of the pool, [1] for all others
    ComputePipeline skin_[2];
};

} // namespace hearth::gpu
