// Finds which pages a frame wants, whether or not they are resident. See runtime/gpu/README.md, "Streaming".
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

    /// What scenes with deformed meshes need beside; once.
    Status prepareDeformed(const Device& device);

    /// The descriptor set of this pass for a streamed scene.
    Status createSet(const Device& device, Scene& scene) const;

    /// Fills SceneBuffers::page_requests, which has been cleared, after the first culling phase of the frame and before the
    /// second. The requests are visible to transfers that follow. Clobbers the compute state.
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene) const;

private:
    static void writeSet(const Device& device, const Scene& scene, VkDescriptorSet set);

    ComputePipeline pipeline_;
    std::optional<ComputePipeline> deformed_; ///< once a scene has deformed meshes
};

} // namespace hearth::gpu
