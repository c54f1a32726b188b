// Finds in which tiles of the picture each material is seen, so that shading a scene of many materials need not look at
// every pixel for each of them. See runtime/gpu/README.md, "Material tiles".
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

    /// The descriptor set of this pass for a scene.
    Status createSet(const Device& device, Scene& scene) const;

    /// Outside a render pass, behind one that ends at the visibility buffer. Writes scene.buffers.tile_draws and
    /// targets.tileLists(), which indirect draws, vertex shaders and transfers that follow see. Clobbers the compute
    /// state.
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                const FrameTargets& targets) const;

private:
    ComputePipeline materials_;
    ComputePipeline offsets_;
    ComputePipeline lists_;
};

} // namespace hearth::gpu
