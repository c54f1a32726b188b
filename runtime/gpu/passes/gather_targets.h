// What one frame leaves to the next of the light that was gathered for a picture, and what shading reads of it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/gather.h"
#include "formats/gpu_shared/records.h"
#include "runtime/gpu/scene/draw_layouts.h"

namespace hearth::gpu
{

/// Of FrameTargets: 4 bytes a pixel.
class GatherTargets
{
public:
    /// arena       outlives what is made
    /// visibility  the image of the targets
    /// sampler     that gives single texels
    /// errors: device_limit, device_failed.
    static Result<GatherTargets> create(const Device& device, const DrawLayouts& layouts, MemoryArena& arena,
                                        VkExtent2D extent, VkImageView visibility, VkSampler sampler);

    VkExtent2D tiles() const { return tiles_; }
    const Image& texels() const { return texels_; }
    const Buffer& view() const { return view_; } ///< shared::GatherView
    /// shared::GatherPoint for each tile, rows from top to bottom: of the last frame.
    const Buffer& points() const { return points_[current_]; }
    VkDescriptorSet pointSet() const { return point_sets_[current_]; }
    VkDescriptorSet gatherSet() const { return gather_sets_[current_]; }

    /// The next frame, seen so: what was this frame's is the one's before. Returns what the device is told.
    ///
    /// grid_origin  world
    shared::GatherView beginFrame(const shared::FrameView& view, Float3 grid_origin, bool light_changes);

    /// The next frame starts anew.
    void forget() { known_ = false; }

private:
    explicit GatherTargets(VkExtent2D tiles) : tiles_(tiles) {}

    VkExtent2D tiles_;
    Buffer view_;
    Buffer points_[2];
    Image texels_; ///< two a tile, side by side
    UniqueDescriptorPool pool_;
    VkDescriptorSet point_sets_[2]{};
    VkDescriptorSet gather_sets_[2]{};

    uint32_t current_ = 0;
    uint32_t frame_ = 0;
    bool known_ = false;
    shared::FrameView before_{};
};

} // namespace hearth::gpu
