// Descriptor sets that join bindings of the scene with those of a frame's images: of shading where a pipeline
// has one set (FrameWay::one_set), and of the pipelines that light stored surfaces.
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

/// Sets of shading with FrameWay::one_set: each joins the set of the scene, a material's, and that of the
/// attachments.
class JoinedSets
{
public:
    /// Join the sets of a scene whose upload is complete, but for the attachments. errors: device_failed.
    static Result<std::unique_ptr<JoinedSets>> create(const Device& device, const DrawLayouts& layouts,
                                                      const Scene& scene);

    /// Join the attachments, unless the sets of this frame in flight hold them. The frame is not yet
    /// recorded, and the one before it in its place has completed.
    void setAttachments(const Device& device, uint32_t frame, const AttachmentSet& attachments);

    /// Join a material's set again after a change. The frame before it in its place has completed.
    void setMaterial(const Device& device, uint32_t frame, size_t row, VkDescriptorSet material);

    /// Join the set of the scene again after a change. The frame before it in its place has completed.
    void setScene(const Device& device, uint32_t frame, VkDescriptorSet scene);

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

/// Images of a frame that the lights read: views of FrameTargets.
struct LitImages
{
    VkImageView surfaces;
    VkImageView depth; ///< without the stencil
    VkSampler sampler; ///< FrameWay::separate only
    std::shared_ptr<const TargetsIdentity> targets;
};

/// Sets of the pipelines that light stored surfaces, the same in all ways through a frame.
class LitSets
{
public:
    /// Copy the bindings of a scene whose upload is complete. errors: device_failed.
    static Result<std::unique_ptr<LitSets>> create(const Device& device, const DrawLayouts& layouts,
                                                   const Scene& scene);

    /// Set the images, unless the set of this frame in flight holds them. The frame is not yet recorded, and
    /// the one before it in its place has completed.
    void setImages(const Device& device, uint32_t frame, const LitImages& images);

    VkDescriptorSet set(uint32_t frame) const { return frames_[frame].set; }

private:
    struct Frame
    {
        VkDescriptorSet set = VK_NULL_HANDLE;
        std::weak_ptr<const TargetsIdentity> targets; ///< whose images the set holds
    };

    UniqueDescriptorPool pool_;
    std::vector<Frame> frames_; ///< for each frame in flight
    bool has_subpasses_ = true;
};

} // namespace hearth::gpu
