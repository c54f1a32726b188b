// Copies words between buffers of a scene on the compute stage. See vulkan/word_copies.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"
#include "runtime/gpu/vulkan/word_copies.h"

namespace hearth::gpu
{

class WordCopyPass
{
public:
    static Result<WordCopyPass> create(const Device& device);

    /// Allocate the descriptor sets of a scene, for those of its frames' copies that it needs.
    Status createSets(const Device& device, Scene& scene) const;

    /// Record a list of copies. Outside a render pass; waits for nothing. Clobbers the compute state.
    void record(const Device& device, VkCommandBuffer commands, VkDescriptorSet set,
                const CopyRange& range) const;

private:
    Result<VkDescriptorSet> createSet(const Device& device, const Scene& scene, const SceneFrame& frame,
                                      const Buffer& source, const Buffer& target) const;

    ComputePipeline pipeline_;
};

} // namespace hearth::gpu
