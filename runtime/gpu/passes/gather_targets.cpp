// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/gather_targets.h"

#include <string>

namespace hearth::gpu
{

Result<GatherTargets> GatherTargets::create(const Device& device, const DrawLayouts& layouts,
                                            MemoryArena& arena, VkExtent2D extent, VkImageView visibility,
                                            VkSampler sampler)
{
    GatherTargets t({shared::gatherTiles(extent.width), shared::gatherTiles(extent.height)});
    const uint64_t bytes = uint64_t{t.tiles_.width} * t.tiles_.height * sizeof(shared::GatherPoint);
    if (bytes > device.limits.maxStorageBufferRange)
        return Error{Issue::device_limit, "", "",
                     "the device cannot bind the gathered light of " + std::to_string(extent.width) + "x" +
                         std::to_string(extent.height) + " pixels"};
    HEARTH_ASSIGN_OR_RETURN(
        t.view_, arena.createBuffer(sizeof(shared::GatherView),
                                    VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                    MemoryKind::device));
    for (Buffer& points : t.points_)
    {
        HEARTH_ASSIGN_OR_RETURN(
            points,
            arena.createBuffer(bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                               MemoryKind::device));
    }
    HEARTH_ASSIGN_OR_RETURN(
        t.texels_, arena.createImage({.format = kFormat,
                                      .extent = {2 * t.tiles_.width, t.tiles_.height},
                                      .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT}));

    const DescriptorPoolSizes sizes{.uniforms = 2, .storages = 6, .textures = 2, .images = 2};
    HEARTH_ASSIGN_OR_RETURN(t.pool_, createDescriptorPool(device, 4, sizes));
    for (const size_t i : {size_t{0}, size_t{1}})
    {
        HEARTH_ASSIGN_OR_RETURN(t.point_sets_[i],
                                allocateSet(device, t.pool_.get(), layouts.gather_point.get()));
        DescriptorWriter(t.point_sets_[i])
            .texture(shared::kGatherPointVisibility, visibility, sampler)
            .storage(shared::kGatherPointPoints, t.points_[i])
            .write(device);
        HEARTH_ASSIGN_OR_RETURN(t.gather_sets_[i], allocateSet(device, t.pool_.get(), layouts.gather.get()));
        DescriptorWriter(t.gather_sets_[i])
            .uniform(shared::kGatherView, t.view_)
            .storage(shared::kGatherPoints, t.points_[i])
            .storage(shared::kGatherHistory, t.points_[1 - i])
            .image(shared::kGatherTexels, t.texels_.view.get())
            .write(device);
    }
    return t;
}

shared::GatherView GatherTargets::beginFrame(const shared::FrameView& view, Float3 grid_origin,
                                             bool light_changes)
{
    shared::GatherView gather{};
    gather.clip_x = before_.clip_x;
    gather.clip_y = before_.clip_y;
    gather.clip_w = before_.clip_w;
    gather.eye_step = view.eye - before_.eye;
    gather.history_frames = light_changes ? shared::kGatherShortHistoryFrames : shared::kGatherHistoryFrames;
    gather.eye = view.eye - grid_origin;
    gather.frame = frame_;
    gather.tiles_x = tiles_.width;
    gather.tiles_y = tiles_.height;
    gather.has_history = has_history_ ? 1 : 0;
    gather.tile_angle = static_cast<float>(shared::kGatherTilePixels) / view.lod_scale;
    gather.tile_size = shared::isOrthographic(view) ? gather.tile_angle : 0;
    before_ = view;
    has_history_ = true;
    current_ = 1 - current_;
    ++frame_;
    return gather;
}

} // namespace hearth::gpu
