// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/post/post_targets.h"

#include "runtime/gpu/vulkan/image_barrier.h"
#include "runtime/gpu/vulkan/sampler.h"

namespace hearth::gpu
{

namespace
{

/// Number of a level or a sum among its kind.
size_t numberFrom(FrameResource resource, FrameResource first)
{
    return static_cast<size_t>(resource) - static_cast<size_t>(first);
}

} // namespace

Result<PostTargets> PostTargets::create(const Device& device, const FramePasses& passes,
                                        const DrawLayouts& layouts, MemoryArena& arena, VkExtent2D extent,
                                        const PostUses& uses)
{
    PostTargets targets;
    HEARTH_TRY(targets.createImages(device, arena, passes.radianceFormat(), extent, uses));
    HEARTH_TRY(targets.createSets(device, layouts, uses));
    return targets;
}

Status PostTargets::createImages(const Device& device, MemoryArena& arena, VkFormat format, VkExtent2D extent,
                                 const PostUses& uses)
{
    constexpr VkImageUsageFlags kUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    HEARTH_ASSIGN_OR_RETURN(sampler_, createClampingSampler(device, VK_FILTER_LINEAR));
    const VkImageUsageFlags copied =
        uses.keeps_radiance ? VkImageUsageFlags{VK_IMAGE_USAGE_TRANSFER_SRC_BIT} : 0;
    const VkImageUsageFlags input =
        uses.is_input ? VkImageUsageFlags{VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT} : 0;
    constexpr VkImageUsageFlags kOnTile =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    HEARTH_ASSIGN_OR_RETURN(
        radiance_,
        arena.createImage({.format = format,
                           .extent = extent,
                           .usage = input | (uses.leaves_tile ? kUsage | copied : kOnTile),
                           .kind = uses.leaves_tile ? MemoryKind::device : MemoryKind::transient}));
    if (!uses.may_bloom)
        return success();
    for (uint32_t level = 1; level <= shared::kBloomLevels; ++level)
    {
        const ImageDescription image{
            .format = format,
            .extent = {shared::bloomSize(extent.width, level), shared::bloomSize(extent.height, level)},
            .usage = kUsage | copied};
        HEARTH_ASSIGN_OR_RETURN(levels_[level - 1], arena.createImage(image));
        if (level < shared::kBloomLevels)
        {
            HEARTH_ASSIGN_OR_RETURN(sums_[level - 1], arena.createImage(image));
        }
    }
    for (Image& exposure : exposures_)
    {
        HEARTH_ASSIGN_OR_RETURN(
            exposure,
            arena.createImage({.format = kExposureFormat, .extent = {1, 1}, .usage = kUsage | copied}));
    }
    return success();
}

Status PostTargets::createSets(const Device& device, const DrawLayouts& layouts, const PostUses& uses)
{
    const auto kSets = static_cast<uint32_t>(down_sets_.size() + up_sets_.size() + exposure_sets_.size() +
                                             final_sets_.size());
    HEARTH_ASSIGN_OR_RETURN(pool_,
                            createDescriptorPool(device, kSets + 1, {.textures = 3 * kSets, .inputs = 1}));
    if (uses.is_input)
    {
        HEARTH_ASSIGN_OR_RETURN(input_set_, allocateSet(device, pool_.get(), layouts.post_input.get()));
        DescriptorWriter(input_set_).input(shared::kPostRadiance, radiance_.view.get()).write(device);
    }
    if (!uses.leaves_tile)
        return success();
    // some drivers look at all descriptors of a set: those that a step does not read have the frame
    const auto create = [&](VkDescriptorSet& set, const Image& source, const Image& bloom,
                            const Image& exposure) -> Status
    {
        HEARTH_ASSIGN_OR_RETURN(set, allocateSet(device, pool_.get(), layouts.post.get()));
        const auto view = [&](const Image& image)
        { return (image.view.get() != VK_NULL_HANDLE ? image : radiance_).view.get(); };
        DescriptorWriter(set)
            .texture(shared::kPostRadiance, view(source), sampler_.get())
            .texture(shared::kPostBloom, view(bloom), sampler_.get())
            .texture(shared::kPostExposure, view(exposure), sampler_.get())
            .write(device);
        return success();
    };
    for (size_t i = 0; i < kLevels; ++i)
        HEARTH_TRY(create(down_sets_[i], i == 0 ? radiance_ : levels_[i - 1], radiance_, radiance_));
    for (size_t i = 0; i + 1 < kLevels; ++i)
        HEARTH_TRY(
            create(up_sets_[i], levels_[i], i + 2 < kLevels ? sums_[i + 1] : levels_[i + 1], radiance_));
    for (size_t i = 0; i < 2; ++i)
    {
        HEARTH_TRY(create(exposure_sets_[i], levels_.back(), radiance_, exposures_[1 - i]));
        HEARTH_TRY(create(final_sets_[i], radiance_, sums_.front(), exposures_[i]));
    }
    return success();
}

const Image& PostTargets::image(FrameResource resource) const
{
    switch (resource)
    {
    case FrameResource::radiance:
        return radiance_;
    case FrameResource::exposure:
        return exposures_[exposure_];
    default:
        break;
    }
    HEARTH_ASSERT(isLinear(resource));
    if (resource >= FrameResource::bloom_sum_1)
        return sums_[numberFrom(resource, FrameResource::bloom_sum_1)];
    return levels_[numberFrom(resource, FrameResource::bloom_level_1)];
}

VkDescriptorSet PostTargets::set(FrameResource target) const
{
    if (target == FrameResource::color)
        return final_sets_[exposure_];
    if (target == FrameResource::exposure)
        return exposure_sets_[exposure_];
    HEARTH_ASSERT(isLinear(target) && target != FrameResource::radiance);
    if (target >= FrameResource::bloom_sum_1)
        return up_sets_[numberFrom(target, FrameResource::bloom_sum_1)];
    return down_sets_[numberFrom(target, FrameResource::bloom_level_1)];
}

void PostTargets::beginFrame(const Device& device, VkCommandBuffer commands, bool blooms,
                             bool adapts_exposure)
{
    had_light_ = has_light_;
    had_exposure_ = has_exposure_;
    has_light_ = blooms || adapts_exposure;
    has_exposure_ = adapts_exposure && (had_light_ || had_exposure_);
    if (!adapts_exposure)
        return;
    exposure_ = 1 - exposure_;
    if (has_layouts_)
        return;
    has_layouts_ = true;
    // shaders that read nothing of an image need it in its layout
    const auto prepare = [&](const Image& image)
    {
        transition(device, commands, image, VK_IMAGE_LAYOUT_UNDEFINED,
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                   VK_ACCESS_SHADER_READ_BIT,
                   VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
                   VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT);
    };
    if (!had_light_)
        prepare(levels_.back());
    prepare(exposures_[1 - exposure_]);
}

} // namespace hearth::gpu
