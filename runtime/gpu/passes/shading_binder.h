// Binds the descriptor sets of shading: one for the scene, each material and the attachments, or one for all.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

/// Refers to its arguments. When it is made, joined sets get the attachments of the targets for frames with a
/// path (JoinedSets::setAttachments).
class ShadingBinder
{
public:
    ShadingBinder(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                  const Scene& scene, const FrameTargets& targets, LightPath path);

    VkPipelineLayout layout() const { return layouts_.shading.get(); }

    /// Bind what all pipelines of layout() share: scene and attachments.
    void bindSurfaces() const;
    /// Bind a material beside them.
    void bindMaterial(size_t row) const;
    /// Bind what the debug views of clusters read.
    void bindClusters() const;

private:
    void bind(VkPipelineLayout layout, uint32_t number, VkDescriptorSet set) const;

    const Device& device_;
    VkCommandBuffer commands_;
    const DrawLayouts& layouts_;
    const Scene& scene_;
    AttachmentSet attachments_;
};

} // namespace hearth::gpu
