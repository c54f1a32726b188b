// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/handles.h"

#include "runtime/gpu/frame/frame_parts.h"
#include "runtime/gpu/frame/frame_plan.h"

using namespace hearth;
using namespace hearth::c;

namespace
{

hearth_image_state toC(const gpu::ImageState& state)
{
    return {state.layout, state.stages, state.access};
}

hearth_image_use toC(const gpu::ImageUse& use)
{
    return {toC(use.before), toC(use.after)};
}

gpu::ImageState toState(const hearth_image_state& state)
{
    return {state.layout, state.stages, state.access};
}

bool operator==(const hearth_image_state& a, const hearth_image_state& b)
{
    return a.layout == b.layout && a.stages == b.stages && a.access == b.access;
}

/// Check the caller's images.
Status checkColors(const hearth_renderer& renderer, const hearth_targets_description& description)
{
    if ((description.color_count == 0) != (description.colors == nullptr))
        return usage("colors is NULL, or color_count is 0, and the other is not");
    for (uint32_t i = 0; i < description.color_count; ++i)
    {
        const hearth_image& image = description.colors[i];
        const std::string name = "image " + std::to_string(i) + " of colors ";
        const gpu::ColorFormat& needed = renderer.renderer->colorFormat();
        if (image.image == VK_NULL_HANDLE)
            return usage(name + "is VK_NULL_HANDLE");
        if (image.format != needed.format)
            return usage(name + "has VkFormat " + std::to_string(static_cast<int>(image.format)) +
                         ", and the renderer's color_format is " + needed.name + " (" +
                         std::to_string(static_cast<int>(needed.format)) + ")");
        if (image.after.layout == VK_IMAGE_LAYOUT_UNDEFINED ||
            image.after.layout == VK_IMAGE_LAYOUT_PREINITIALIZED)
            return usage(name + "has no layout after a frame: after.layout");
        if (!(image.before == description.colors[0].before && image.after == description.colors[0].after))
            return usage(name + "has another `before` or `after` than image 0");
    }
    return success();
}

gpu::CallerImages toImages(const hearth_targets_description& description)
{
    gpu::CallerImages colors;
    for (uint32_t i = 0; i < description.color_count; ++i)
        colors.images.push_back(description.colors[i].image);
    if (description.color_count > 0)
        colors.before = toState(description.colors->before),
        colors.after = toState(description.colors->after);
    return colors;
}

/// Return an image of the targets before and after a whole frame.
hearth_image makeImage(const gpu::Image& image, const gpu::ImageUse& drawn, const gpu::ImageUse& shaded)
{
    // a part that does not touch the image has no stages
    const gpu::ImageUse& first = drawn.before.stages != 0 ? drawn : shaded;
    return {.image = image.handle.get(),
            .format = image.format,
            .before = toC(first.before),
            .after = toC(shaded.after)};
}

/// Return the image that frames show; of the caller's images the first.
hearth_image makeColor(const gpu::FrameTargets& targets, const gpu::ImageUse& drawn,
                       const gpu::ImageUse& shaded)
{
    hearth_image color = makeImage(targets.color(), drawn, shaded);
    if (const gpu::CallerImages& colors = targets.options().colors; !colors.images.empty())
    {
        color.image = colors.images.front();
        color.before = toC(colors.before);
        color.after = toC(colors.after);
    }
    return color;
}

/// Return the depth, which the caller gets and gives back in one layout.
hearth_image makeDepth(const gpu::Image& image)
{
    const VkImageLayout layout = gpu::accessLayout(gpu::Access::sampled);
    return {.image = image.handle.get(),
            .format = image.format,
            .before = {layout, gpu::kCallerDepthStages, gpu::kCallerDepthAccess},
            .after = {layout, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT}};
}

/// Return the motion vectors, which a pass behind a frame draws.
hearth_image makeMotion(const gpu::Image& image)
{
    return {.image = image.handle.get(),
            .format = image.format,
            .before = {VK_IMAGE_LAYOUT_UNDEFINED, gpu::kMotionReaders, gpu::kMotionReads},
            .after = {gpu::kMotionLayout, gpu::kMotionReaders, gpu::kMotionReads}};
}

/// Return the filtered frame, which a pass behind the motion vectors draws.
hearth_image makeFiltered(const gpu::Image& image)
{
    return {.image = image.handle.get(),
            .format = image.format,
            .before = {VK_IMAGE_LAYOUT_UNDEFINED, gpu::kFilterReaders, gpu::kFilterReads},
            .after = {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, gpu::kFilterReaders, gpu::kFilterReads}};
}

uint32_t toLightPaths(uint32_t flags)
{
    constexpr std::pair<uint32_t, gpu::LightPath> kPaths[] = {
        {HEARTH_TARGETS_DEFERRED, gpu::LightPath::surfaces},
        {HEARTH_TARGETS_TILE_DEFERRED, gpu::LightPath::surfaces_on_tile},
        {HEARTH_TARGETS_PREPASS, gpu::LightPath::light_sums},
        {HEARTH_TARGETS_CLASSIC_PREPASS, gpu::LightPath::joint_sums},
        {HEARTH_TARGETS_ENCODED_PREPASS, gpu::LightPath::encoded_joint_sums},
        {HEARTH_TARGETS_STACK, gpu::LightPath::light_bits}};
    uint32_t paths = 0;
    for (const auto& [flag, path] : kPaths)
        paths |= (flags & flag) != 0 ? gpu::lightPathBit(path) : 0;
    return paths;
}

Status check(const hearth_renderer& renderer, const hearth_targets_description& description)
{
    if (description.width == 0 || description.height == 0)
        return usage("width or height is 0");
    if (description.occlusion > HEARTH_OCCLUSION_OFF)
        return usage("occlusion has a value that this version does not know");
    constexpr uint32_t kFlags =
        HEARTH_TARGETS_KEEP_VISIBILITY | HEARTH_TARGETS_SPLIT | HEARTH_TARGETS_COUNT_MISSING |
        HEARTH_TARGETS_BLOOM | HEARTH_TARGETS_DEFERRED | HEARTH_TARGETS_TILE_DEFERRED | HEARTH_TARGETS_STACK |
        HEARTH_TARGETS_PREPASS | HEARTH_TARGETS_CLASSIC_PREPASS | HEARTH_TARGETS_ENCODED_PREPASS |
        HEARTH_TARGETS_MOTION | HEARTH_TARGETS_ANTI_ALIASING;
    if ((description.flags & ~kFlags) != 0)
        return usage("flags has bits that this version does not know");
    if ((description.output_width == 0) != (description.output_height == 0))
        return usage("output_width or output_height is 0");
    if ((description.flags & HEARTH_TARGETS_ANTI_ALIASING) != 0 &&
        ((description.output_width != 0 && description.output_width != description.width) ||
         (description.output_height != 0 && description.output_height != description.height)))
        return usage("HEARTH_TARGETS_ANTI_ALIASING needs an output of the size that is drawn");
    if ((description.flags & HEARTH_TARGETS_ANTI_ALIASING) != 0 &&
        (description.color_count != 0 || renderer.renderer->colorFormat().format != VK_FORMAT_R8G8B8A8_SRGB))
        return usage(
            "HEARTH_TARGETS_ANTI_ALIASING filters an image of the targets in R8G8B8A8_SRGB: leave out colors "
            "and color_format, and copy hearth_targets_info.filtered");
    const bool needs_final_pass =
        (description.flags & HEARTH_TARGETS_BLOOM) != 0 || description.output_width != 0;
    if (needs_final_pass && !renderer.renderer->hasFinalPasses())
        return usage("HEARTH_TARGETS_BLOOM and an output size need a renderer with "
                     "HEARTH_FEATURE_FINAL_PASS");
    if (toLightPaths(description.flags) != 0 && !renderer.renderer->supports(gpu::LightMethod::deferred))
        return usage("HEARTH_TARGETS_DEFERRED, _TILE_DEFERRED, _STACK, _PREPASS and _CLASSIC_PREPASS need a "
                     "renderer with HEARTH_FEATURE_DEFERRED");
    if (description.scene != nullptr && description.scene->renderer != &renderer)
        return usage("the scene is of another renderer");
    return checkColors(renderer, description);
}

/// Create the pass of the temporal filter, unless it is there.
Status prepareFilter(hearth_renderer& handle, const hearth_targets_description& description)
{
    if ((description.flags & HEARTH_TARGETS_ANTI_ALIASING) == 0 || handle.temporal)
        return success();
    HEARTH_ASSIGN_OR_RETURN(gpu::TemporalPass made,
                            gpu::TemporalPass::create(handle.renderer->device(), handle.renderer->layouts()));
    handle.temporal.emplace(std::move(made));
    return success();
}

gpu::TargetOptions toOptions(const hearth_targets_description& description)
{
    gpu::TargetOptions options{.occlusion = toOcclusion(description.occlusion),
                               .keeps_visibility = (description.flags & HEARTH_TARGETS_KEEP_VISIBILITY) != 0,
                               .counts_missing = (description.flags & HEARTH_TARGETS_COUNT_MISSING) != 0,
                               .may_bloom = (description.flags & HEARTH_TARGETS_BLOOM) != 0,
                               .output = {description.output_width, description.output_height},
                               .colors = toImages(description),
                               .light_paths = toLightPaths(description.flags),
                               .has_motion = (description.flags & HEARTH_TARGETS_MOTION) != 0,
                               .has_temporal_filter =
                                   (description.flags & HEARTH_TARGETS_ANTI_ALIASING) != 0};
    if (description.scene == nullptr)
        return options;
    const gpu::Scene& scene = *description.scene->scene;
    options.gathers_light = scene.bricks != nullptr;
    options.may_split = options.gathers_light || (description.flags & HEARTH_TARGETS_SPLIT) != 0 ||
                        gpu::shadesTiles(scene, gpu::ShadedArea::automatic);
    return options;
}

} // namespace

gpu::OcclusionCulling hearth::c::toOcclusion(uint32_t occlusion)
{
    switch (occlusion)
    {
    case HEARTH_OCCLUSION_OFF:
        return gpu::OcclusionCulling::off;
    case HEARTH_OCCLUSION_LAST_FRAME:
        return gpu::OcclusionCulling::last_frame;
    default:
        return gpu::OcclusionCulling::two_phase;
    }
}

hearth_result hearth_targets_create(hearth_renderer* renderer, const hearth_targets_description* description,
                                    hearth_targets** targets)
{
    if (renderer == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(renderer->message(), __func__,
                [&]() -> Status
                {
                    if (targets == nullptr)
                        return usage("targets is NULL");
                    HEARTH_TRY(checkStruct("description", description));
                    HEARTH_TRY(check(*renderer, *description));
                    HEARTH_TRY(prepareFilter(*renderer, *description));
                    HEARTH_ASSIGN_OR_RETURN(
                        gpu::FrameTargets made,
                        renderer->renderer->createTargets({description->width, description->height},
                                                          toOptions(*description)));
                    *targets = new hearth_targets{renderer, std::move(made)};
                    ++renderer->targets_count;
                    return success();
                });
}

hearth_result hearth_targets_destroy(hearth_targets* targets)
{
    if (targets != nullptr)
        --targets->renderer->targets_count;
    delete targets;
    return HEARTH_OK;
}

hearth_result hearth_targets_get_info(const hearth_targets* targets, hearth_targets_info* info)
{
    if (targets == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(targets->renderer->message(), __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkStruct("info", info));
                    const gpu::FrameTargets& t = targets->targets;
                    const bool keeps = t.options().keeps_visibility;
                    const gpu::PartImages drawn = partImages(gpu::FramePart::visibility, keeps);
                    const gpu::PartImages shaded = partImages(gpu::FramePart::materials, keeps);
                    *info = {.struct_size = sizeof(*info),
                             .width = t.extent().width,
                             .height = t.extent().height,
                             .reserved = 0,
                             .color = makeColor(t, drawn.color, shaded.color),
                             .visibility = makeImage(t.visibility(), drawn.visibility, shaded.visibility),
                             .allocated_bytes = t.allocatedBytes(),
                             .transient_bytes = t.transientBytes()};
                    if (!keeps)
                        info->visibility.image = VK_NULL_HANDLE;
                    if (targets->renderer->renderer->keepsDepth())
                        info->depth = makeDepth(t.depth());
                    if (t.options().has_motion)
                        info->motion = makeMotion(t.motion().image());
                    if (t.options().has_temporal_filter)
                        info->filtered = makeFiltered(t.temporal().filtered());
                    return success();
                });
}

hearth_result hearth_targets_get_part_info(const hearth_targets* targets, uint32_t part,
                                           hearth_part_info* info)
{
    if (targets == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(targets->renderer->message(), __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkStruct("info", info));
                    if (part > HEARTH_PART_MATERIALS)
                        return usage("part is not one that this version knows");
                    const gpu::PartImages images = gpu::partImages(
                        static_cast<gpu::FramePart>(part), targets->targets.options().keeps_visibility);
                    info->color = toC(images.color);
                    const gpu::CallerImages& colors = targets->targets.options().colors;
                    if (!colors.images.empty() && images.color.after.stages != 0)
                        info->color = {toC(colors.before), toC(colors.after)};
                    info->visibility = toC(images.visibility);
                    return success();
                });
}
