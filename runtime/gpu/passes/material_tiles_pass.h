// Lists the tiles in which each material is visible, so that shading a scene of many materials need not test
// every pixel for each material. See runtime/gpu/README.md, "Material tiles".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

class MaterialTilesPass
{
public:
    static Result<MaterialTilesPass> create(const Device& device, const DrawLayouts& layouts);

    /// Allocate the descriptor sets of this pass for a scene.
    Status createSets(const Device& device, Scene& scene) const;

    /// Record outside a render pass, after a render pass that ends at the visibility buffer. Writes the
    /// draws of tiles of the scene's frame and targets.tileLists(), visible to later indirect draws, vertex
    /// shaders and transfers. Clobbers the compute state.
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                const FrameTargets& targets) const;

private:
    ComputePipeline materials_;
    ComputePipeline offsets_;
    ComputePipeline lists_;
};

} // namespace hearth::gpu
