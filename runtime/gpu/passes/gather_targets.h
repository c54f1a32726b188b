// Gathered light (GI) of one camera: the history that one frame leaves to the next, and the result that
// shading reads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/gather.h"
#include "formats/gpu_shared/records.h"
#include "runtime/gpu/scene/draw_layouts.h"

namespace hearth::gpu
{

/// Part of FrameTargets: 4 bytes per pixel.
class GatherTargets
{
public:
    static constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_UINT; ///< of texels()

    /// arena       outlives the targets
    /// visibility  image of FrameTargets
    /// sampler     nearest
    /// errors: device_limit, device_failed.
    static Result<GatherTargets> create(const Device& device, const DrawLayouts& layouts, MemoryArena& arena,
                                        VkExtent2D extent, VkImageView visibility, VkSampler sampler);

    VkExtent2D tiles() const { return tiles_; }
    const Image& texels() const { return texels_; }
    const Buffer& view() const { return view_; } ///< shared::GatherView
    /// shared::GatherPoint of each tile in the last frame, rows from top to bottom.
    const Buffer& points() const { return points_[current_]; }
    VkDescriptorSet pointSet() const { return point_sets_[current_]; }
    VkDescriptorSet gatherSet() const { return gather_sets_[current_]; }

    /// Begin a frame with this view: the result of the last frame becomes the history. Returns the view for
    /// the device.
    ///
    /// grid_origin  world
    shared::GatherView beginFrame(const shared::FrameView& view, Float3 grid_origin, bool light_changes);

    /// Discard the history.
    void forget() { has_history_ = false; }

private:
    explicit GatherTargets(VkExtent2D tiles) : tiles_(tiles) {}

    VkExtent2D tiles_;
    Buffer view_;
    Buffer points_[2];
    Image texels_; ///< two texels per tile, side by side
    UniqueDescriptorPool pool_;
    VkDescriptorSet point_sets_[2]{};
    VkDescriptorSet gather_sets_[2]{};

    uint32_t current_ = 0;
    uint32_t frame_ = 0;
    bool has_history_ = false;
    shared::FrameView before_{};
};

} // namespace hearth::gpu
