// Images of frames with a final pass: the linear frame, levels of bloom, and the exposure that one frame
// leaves to the next.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/frame/frame_passes.h"
#include "runtime/gpu/scene/draw_layouts.h"

#include <array>

namespace hearth::gpu
{

/// Uses of the images of frames with a final pass.
struct PostUses
{
    bool leaves_tile = true;     ///< the linear frame does, and frames may have bloom or another size
    bool is_input = false;       ///< the final pass may read the pixel's own value
    bool may_bloom = false;      ///< or have automatic exposure: 2.7 texels for 4 pixels
    bool keeps_radiance = false; ///< the images can be copied
};

/// Part of FrameTargets.
class PostTargets
{
public:
    /// arena  outlives the targets
    /// errors: device_failed.
    static Result<PostTargets> create(const Device& device, const FramePasses& passes,
                                      const DrawLayouts& layouts, MemoryArena& arena, VkExtent2D extent,
                                      const PostUses& uses);

    const Image& radiance() const { return image(FrameResource::radiance); }
    bool mayBloom() const { return image(FrameResource::exposure).view.get() != VK_NULL_HANDLE; }
    /// Image of a resource of a final pass; those of the exposure are of the frame begun last. Without
    /// memory and view if no frame uses it.
    const Image& image(FrameResource resource) const;
    /// Number of the exposure image of the frame begun last.
    uint32_t exposureNumber() const { return exposure_; }
    const Image& exposureImage(uint32_t number) const { return exposures_[number]; }

    /// Set of a step that draws to a resource; the final pass draws to `color`.
    VkDescriptorSet set(FrameResource target) const;
    /// Set of a final pass that reads the pixel's own value; with PostUses::is_input.
    VkDescriptorSet inputSet() const { return input_set_; }

    /// Begin a frame. Records the first layouts of images that it reads and no frame has drawn to.
    void beginFrame(const Device& device, VkCommandBuffer commands, bool blooms, bool adapts_exposure);
    /// True if the frame before has left its last level of bloom.
    bool hasLight() const { return had_light_; }
    /// True if it has left an exposure that follows any light.
    bool hasExposure() const { return had_exposure_; }

private:
    PostTargets() = default;
    Status createImages(const Device& device, MemoryArena& arena, VkFormat format, VkExtent2D extent,
                        const PostUses& uses);
    Status createSets(const Device& device, const DrawLayouts& layouts, const PostUses& uses);

    static constexpr size_t kLevels = shared::kBloomLevels;

    Image radiance_;
    std::array<Image, kLevels> levels_;   ///< [level - 1]
    std::array<Image, kLevels - 1> sums_; ///< [level - 1]
    std::array<Image, 2> exposures_;
    UniqueSampler sampler_;
    UniqueDescriptorPool pool_;
    std::array<VkDescriptorSet, kLevels> down_sets_{};
    std::array<VkDescriptorSet, kLevels - 1> up_sets_{};
    std::array<VkDescriptorSet, 2> exposure_sets_{}; ///< [exposure_]
    std::array<VkDescriptorSet, 2> final_sets_{};    ///< [exposure_]
    VkDescriptorSet input_set_ = VK_NULL_HANDLE;
    uint32_t exposure_ = 0;
    bool has_layouts_ = false;
    bool had_light_ = false, had_exposure_ = false; ///< the frame before
    bool has_light_ = false, has_exposure_ = false; ///< the frame begun last
};

} // namespace hearth::gpu
