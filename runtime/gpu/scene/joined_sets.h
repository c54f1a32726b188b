// Descriptor sets of shading where a pipeline has one set (FrameWay::one_set): each joins the set of the
// scene, a material's, and that of the attachments.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/draw_layouts.h"

#include <memory>
#include <vector>

namespace hearth::gpu
{

struct Scene;

/// Names one FrameTargets: joined sets have to know whose attachments they hold.
struct TargetsIdentity
{
};

/// Attachments to join: the set of FrameTargets.
struct AttachmentSet
{
    VkDescriptorSet set;
    std::shared_ptr<const TargetsIdentity> targets;
};

class JoinedSets
{
public:
    /// Join the sets of a scene whose upload is complete, but for the attachments. errors: device_failed.
    static Result<std::unique_ptr<JoinedSets>> create(const Device& device, const DrawLayouts& layouts,
                                                      const Scene& scene);

    /// Join the attachments, unless the sets of this frame in flight hold them. The frame is not yet
    /// recorded, and the one before it in its place has completed.
    void setAttachments(const Device& device, uint32_t frame, const AttachmentSet& attachments);

    VkDescriptorSet material(uint32_t frame, size_t row) const { return frames_[frame].materials[row]; }
    VkDescriptorSet clusters(uint32_t frame) const { return frames_[frame].clusters; }

private:
    struct Frame
    {
        std::vector<VkDescriptorSet> materials; ///< [row]
        VkDescriptorSet clusters = VK_NULL_HANDLE;
        std::weak_ptr<const TargetsIdentity> targets; ///< whose attachments the sets hold
    };

    UniqueDescriptorPool pool_;
    std::vector<Frame> frames_; ///< for each frame in flight
    ShadingBindings bindings_;
};

} // namespace hearth::gpu
