// Page requests: finds the pages that a frame needs, resident or not. See runtime/gpu/README.md, "Streaming".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"

#include <optional>

namespace hearth::gpu
{

class PageRequestPass
{
public:
    static Result<PageRequestPass> create(const Device& device);

    /// Create the pipeline for scenes with deformed meshes; call once.
    Status prepareDeformed(const Device& device);

    /// Allocate the descriptor set of this pass for a streamed scene.
    Status createSets(const Device& device, Scene& scene) const;

    /// Record between the first culling phase of the frame and the second. Fills SceneBuffers::page_requests,
    /// which has been cleared; visible to later transfers. Clobbers the compute state.
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene) const;

private:
    ComputePipeline pipeline_;
    std::optional<ComputePipeline> deformed_; ///< set once a scene has deformed meshes
};

} // namespace hearth::gpu
