// Images of frames with a final pass: the linear frame, levels of bloom, and the exposure that one frame
// leaves to the next.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/frame/frame_passes.h"
#include "runtime/gpu/scene/draw_layouts.h"

#include <array>

namespace hearth::gpu
{

/// Part of FrameTargets.
class PostTargets
{
public:
    /// arena           outlives the targets
    /// may_bloom       frames may have bloom or automatic exposure: 2.7 texels for 4 pixels
    /// keeps_radiance  the images can be copied
    /// errors: device_failed.
    static Result<PostTargets> create(const Device& device, const FramePasses& passes,
                                      const DrawLayouts& layouts, MemoryArena& arena, VkExtent2D extent,
                                      bool may_bloom, bool keeps_radiance);

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

    /// Begin a frame. Records the first layouts of images that it reads and no frame has drawn to.
    void beginFrame(const Device& device, VkCommandBuffer commands, bool blooms, bool adapts_exposure);
    /// True if the frame before has left its last level of bloom.
    bool hasLight() const { return had_light_; }
    /// True if it has left an exposure that follows any light.
    bool hasExposure() const { return had_exposure_; }

private:
    PostTargets() = default;
    Status createImages(const Device& device, MemoryArena& arena, VkFormat format, VkExtent2D extent,
                        bool may_bloom, bool keeps_radiance);
    Status createSets(const Device& device, const DrawLayouts& layouts);

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
    uint32_t exposure_ = 0;
    bool has_layouts_ = false;
    bool had_light_ = false, had_exposure_ = false; ///< the frame before
    bool has_light_ = false, has_exposure_ = false; ///< the frame begun last
};

} // namespace hearth::gpu
