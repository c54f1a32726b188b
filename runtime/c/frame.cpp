// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/camera.h"
#include "runtime/c/lights.h"
#include "runtime/c/shadows.h"

#include "runtime/frame/lod_curve.h"
#include "runtime/gpu/frame/frame_text.h"
#include "runtime/gpu/vulkan/pipelines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

using namespace hearth;
using namespace hearth::c;

namespace
{

bool isShare(float value)
{
    return value >= 0 && value <= 1;
}

/// Check what follows the lighting.
Status checkPost(const gpu::Renderer& renderer, const hearth_frame& frame)
{
    if (!std::isfinite(frame.exposure_stops) || std::abs(frame.exposure_stops) > 64)
        return usage("exposure_stops is not from -64 to 64");
    if (frame.automatic_exposure > 1 || frame.bloom_mode > HEARTH_BLOOM_ADD)
        return usage("automatic_exposure is neither 0 nor 1, or bloom_mode is unknown to this version");
    if (!isShare(frame.filter_density) || !isShare(frame.bloom_strength) ||
        !std::all_of(frame.filter_color, frame.filter_color + 3, isShare))
        return usage("filter_color, filter_density or bloom_strength is not from 0 to 1");
    if (!(frame.exposure_key > 0) || !std::isfinite(frame.exposure_key) ||
        !(frame.exposure_time_constant >= 0) || !(frame.exposure_time_step >= 0))
        return usage("exposure_key is not above 0, or exposure_time_constant or _time_step below 0");
    const bool has_grading = frame.exposure_stops != 0 || frame.filter_density != 0;
    if (has_grading && renderer.postSupport() == gpu::PostSupport::none)
        return usage("exposure_stops and filter_density need a renderer with HEARTH_FEATURE_GRADING");
    if (frame.filter_density != 0 && renderer.colorFormat().content == gpu::ColorContent::radiance)
        return usage("filter_density is not 0, and the color_format has radiance, ahead of the tone curve");
    return success();
}

Status check(const hearth_renderer& renderer, const hearth_frame& frame)
{
    HEARTH_TRY(checkCamera(frame));
    if (!(frame.error_pixels >= 0) || !std::isfinite(frame.error_pixels))
        return usage("error_pixels is not 0 or more");
    if (!(frame.depth_scale > 0) || !std::isfinite(frame.depth_scale))
        return usage("depth_scale is not above 0");
    if ((frame.cull_flags & ~uint32_t{HEARTH_CULL_EVERYTHING}) != 0)
        return usage("cull_flags has bits that this version does not know");
    if (shared::findDebugView(frame.debug_view) == nullptr || frame.shaded_area > HEARTH_SHADE_TILES)
        return usage("debug_view or shaded_area has a value that this version does not know");
    if (frame.ambient_occlusion > HEARTH_AMBIENT_OCCLUSION_OFF ||
        frame.specular_occlusion > HEARTH_SPECULAR_OCCLUSION_OFF)
        return usage("ambient_occlusion or specular_occlusion has a value that this version does not know");
    if (frame.debug_view == HEARTH_VIEW_OVERDRAW && !renderer.shows_overdraw)
        return usage("HEARTH_VIEW_OVERDRAW needs a renderer with HEARTH_FEATURE_OVERDRAW");
    if (frame.lod_knot_count > 0 && frame.lod_knots == nullptr)
        return usage("lod_knots is NULL");
    if (frame.move_count > 0 && frame.moves == nullptr)
        return usage("moves is NULL");
    if (frame.pose_count > 0 && frame.poses == nullptr)
        return usage("poses is NULL");
    if (frame.shadow_sphere_count > 0 && frame.shadow_spheres == nullptr)
        return usage("shadow_spheres is NULL");
    if (frame.occlusion > HEARTH_OCCLUSION_OFF)
        return usage("occlusion has a value that this version does not know");
    if (!std::all_of(std::begin(frame.material_inputs), std::end(frame.material_inputs),
                     [](float input) { return std::isfinite(input); }))
        return usage("material_inputs are not all finite");
    if (frame.constant_sky > 1)
        return usage("constant_sky is neither 0 nor 1");
    if (frame.light_lists > HEARTH_LIGHT_LISTS_CPU)
        return usage("light_lists has a value that this version does not know");
    return checkPost(*renderer.renderer, frame);
}

gpu::PostSettings makePost(const hearth_frame& frame)
{
    gpu::PostSettings post{.exposure_stops = frame.exposure_stops,
                           .photo_filter = {toFloat3(frame.filter_color), frame.filter_density},
                           .bloom = {frame.bloom_strength, frame.bloom_mode == HEARTH_BLOOM_ADD
                                                               ? gpu::BloomMode::add
                                                               : gpu::BloomMode::mix}};
    if (frame.automatic_exposure != 0)
        post.automatic_exposure = {frame.exposure_key, frame.exposure_time_constant,
                                   frame.exposure_time_step};
    return post;
}

gpu::ShadingSettings makeShading(const hearth_frame& frame)
{
    return {.debug_view = frame.debug_view,
            .depth_scale = frame.depth_scale,
            .area = static_cast<gpu::ShadedArea>(frame.shaded_area),
            .ambient_occlusion = frame.ambient_occlusion,
            .specular_occlusion = frame.specular_occlusion,
            .gi = frame.constant_sky == 0,
            .light_method = static_cast<gpu::LightMethod>(frame.light_method),
            .light_lister = static_cast<gpu::LightLister>(frame.light_lists),
            .post = makePost(frame)};
}

/// Check a frame of the scene with the targets.
Status checkFrame(const hearth_scene& scene, const hearth_targets& targets, const hearth_frame* frame)
{
    if (targets.renderer != scene.renderer)
        return usage("scene and targets are of different renderers");
    HEARTH_TRY(checkStruct("frame", frame));
    HEARTH_TRY(check(*scene.renderer, *frame));
    if (frame->debug_view == HEARTH_VIEW_SHADOW_MAPS && scene.scene->shadows == nullptr)
        return usage("HEARTH_VIEW_SHADOW_MAPS needs a scene with shadows");
    if (shared::viewNeedsBricks(frame->debug_view) && scene.scene->bricks == nullptr)
        return usage("HEARTH_VIEW_BRICKS, _BRICK_LIGHTING and _GI need a scene whose pack has bricks");
    if (frame->light_method >= gpu::kLightMethodCount ||
        (scene.prepared_lights >> frame->light_method & 1) == 0)
        return usage("light_method is unknown, or hearth_scene_prepare_lights has not prepared it");
    const gpu::LightPath path = gpu::neededLightPath(targets.targets, makeShading(*frame));
    if (!targets.targets.options().allows(path))
        return usage("light_method needs targets with its flag: HEARTH_TARGETS_DEFERRED, _STACK, _PREPASS, "
                     "_CLASSIC_PREPASS or _ENCODED_PREPASS");
    const bool blooms = frame->bloom_strength > 0 || frame->automatic_exposure != 0;
    if (blooms && !targets.targets.options().may_bloom)
        return usage("bloom_strength and automatic_exposure need targets with HEARTH_TARGETS_BLOOM");
    if (frame->color_image >= std::max<size_t>(1, targets.targets.options().colors.images.size()))
        return usage("color_image is not the number of one of the targets' colors");
    return success();
}

/// Check that the scene and the targets can be recorded into now. The scene is not NULL.
Status checkCall(const hearth_scene& scene, const hearth_targets* targets, VkCommandBuffer commands,
                 const hearth_frame* frame)
{
    if (targets == nullptr || commands == VK_NULL_HANDLE)
        return usage("targets or commands is NULL");
    return checkFrame(scene, *targets, frame);
}

/// Check that the targets were created for what the frame asks.
Status checkTargets(const hearth_scene& scene, const gpu::FrameTargets& targets, const hearth_frame& frame,
                    bool in_parts)
{
    const gpu::TargetOptions& options = targets.options();
    const bool gathers = scene.scene->bricks != nullptr && frame.constant_sky == 0;
    if ((frame.cull_flags & HEARTH_CULL_OCCLUSION) != 0 && toOcclusion(frame.occlusion) > options.occlusion)
        return usage("the targets were created for less occlusion culling than the frame has");
    if (gathers && !options.gathers_light)
        return usage("the targets were created for a scene without bricks");
    const auto area = static_cast<gpu::ShadedArea>(frame.shaded_area);
    const auto method = static_cast<gpu::LightMethod>(frame.light_method);
    const bool splits = in_parts || gathers || gpu::shadesTiles(*scene.scene, area) ||
                        needPixels(gpu::lightMethodFacts(method).areas);
    if (splits && !options.may_split)
        return usage("the targets were created for a scene of few materials: frames in parts, with material "
                     "tiles, or with tiled or clustered lights need HEARTH_TARGETS_SPLIT");
    return success();
}

/// Checks that the targets do not belong to another scene.
Status checkOwner(const hearth_scene& scene, const hearth_targets& targets)
{
    const std::shared_ptr<const gpu::Scene> owner = targets.scene.lock();
    if (owner != nullptr && owner != scene.scene)
        return usage("the targets belong to another scene, whose image this one would draw over: create "
                     "targets for each scene, or destroy the other scene first");
    return success();
}

/// Check that a frame of the scene may begin.
Status checkFrameBegun(const hearth_scene& scene)
{
    if (scene.scene->stream != nullptr && !scene.to_be_recorded)
        return usage("the scene has a memory_budget: each frame begins with hearth_scene_begin_frame");
    return success();
}

Status setCurve(shared::FrameView& view, const hearth_frame& frame)
{
    if (frame.lod_knot_count > shared::kMaxLodKnots)
        return usage("lod_knot_count is above " + std::to_string(shared::kMaxLodKnots));
    std::array<shared::LodKnot, shared::kMaxLodKnots> knots;
    for (uint32_t i = 0; i < frame.lod_knot_count; ++i)
        knots[i] = {frame.lod_knots[i].distance, frame.lod_knots[i].factor};
    return shared::setLodCurve(view, std::span(knots).first(frame.lod_knot_count));
}

Result<shared::FrameView> makeView(const hearth_scene& scene, const gpu::FrameTargets& targets,
                                   const hearth_frame& frame)
{
    const uint32_t off = frame.occlusion == HEARTH_OCCLUSION_OFF ? uint32_t{HEARTH_CULL_OCCLUSION} : 0;
    shared::FrameView view =
        shared::makeFrameView(toCamera(frame), targets.extent().width, targets.extent().height,
                              frame.error_pixels, scene.scene->instance_count, frame.cull_flags & ~off);
    HEARTH_TRY(setCurve(view, frame));
    const float* inputs = frame.material_inputs;
    view.material_inputs = {inputs[0], inputs[1], inputs[2], inputs[3]};
    return view;
}

/// Fill scene.moves.
Status makeMoves(hearth_scene& scene, const hearth_frame& frame)
{
    scene.moves.clear();
    for (uint32_t i = 0; i < frame.move_count; ++i)
    {
        Affine3 world_from_object;
        static_assert(sizeof(world_from_object.m) == sizeof(frame.moves[i].world_from_object));
        std::copy_n(&frame.moves[i].world_from_object[0][0], 12, &world_from_object.m[0][0]);
        HEARTH_ASSIGN_OR_RETURN(const gpu::InstanceMove move,
                                gpu::moveInstance(*scene.scene, frame.moves[i].instance, world_from_object));
        scene.moves.push_back(move);
    }
    return success();
}

/// Fill scene.poses, which refer to the caller's data.
Status makePoses(hearth_scene& scene, const hearth_frame& frame)
{
    scene.poses.clear();
    for (uint32_t i = 0; i < frame.pose_count; ++i)
    {
        const hearth_pose& pose = frame.poses[i];
        if ((pose.joint_count > 0 && pose.world_from_bind == nullptr) ||
            (pose.morph_weight_count > 0 && pose.morph_weights == nullptr))
            return usage("world_from_bind or morph_weights of pose " + std::to_string(i) + " is NULL");
        scene.poses.push_back(
            {.instance = pose.instance,
             .world_from_bind = {reinterpret_cast<const Affine3d*>(pose.world_from_bind), pose.joint_count},
             .morph_weights = {pose.morph_weights, pose.morph_weight_count},
             .free = pose.is_free != 0});
        HEARTH_TRY(gpu::checkPose(*scene.scene, scene.poses.back()));
    }
    return success();
}

/// Uses the moves, poses, lights and shadow spheres of the frame's first part.
Result<gpu::FrameInput> makeInput(const hearth_scene& scene, const gpu::FrameTargets& targets,
                                  const hearth_frame& frame)
{
    HEARTH_ASSIGN_OR_RETURN(const shared::FrameView view, makeView(scene, targets, frame));
    return gpu::FrameInput{.view = view,
                           .shading = makeShading(frame),
                           .occludes_by_last_frame = frame.occlusion == HEARTH_OCCLUSION_LAST_FRAME,
                           .moves = scene.moves,
                           .poses = scene.poses,
                           .shadow_spheres = scene.shadow_spheres,
                           .lights = scene.lights,
                           .daylight = scene.daylight ? &*scene.daylight : nullptr,
                           .lamp_weights = scene.lamp_weights,
                           .emission = scene.emissions,
                           .color_image = frame.color_image,
                           .timestamps = frame.timestamps};
}

/// Progress of a frame: recorded by one call, or by three in this order.
enum FrameProgress : uint32_t
{
    kNothing = 0, ///< or a whole frame
    kCulled = 1,
    kVisible = 2,
};

/// Take the per-frame inputs, before any part of the frame is recorded.
Status beginFrame(hearth_scene& scene, const hearth_frame& frame)
{
    HEARTH_TRY(checkFrameBegun(scene));
    HEARTH_TRY(makeMoves(scene, frame));
    HEARTH_TRY(makePoses(scene, frame));
    HEARTH_TRY(makeDaylight(scene, frame));
    HEARTH_TRY(makeLights(scene, frame));
    HEARTH_TRY(makeLampWeights(scene, frame));
    HEARTH_TRY(makeEmissions(scene, frame));
    return makeShadowSpheres(scene, frame);
}

Status checkOrder(const hearth_scene& scene, const hearth_targets* targets, FrameProgress before)
{
    if (scene.parts_recorded != before || scene.parts_targets != targets)
        return usage("the parts of a frame are recorded in order, with the same targets");
    return success();
}

/// Run one record call; `record` is the renderer's function for it.
template <typename Record>
hearth_result recordParts(const char* function, FrameProgress before, FrameProgress after,
                          const Record& record, hearth_scene* scene, hearth_targets* targets,
                          VkCommandBuffer commands, const hearth_frame* frame)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    const auto work = [&]() -> Status
    {
        HEARTH_TRY(checkCall(*scene, targets, commands, frame));
        HEARTH_TRY(checkOwner(*scene, *targets));
        HEARTH_TRY(checkTargets(*scene, targets->targets, *frame, before != kNothing || after != kNothing));
        HEARTH_TRY(before == kNothing ? beginFrame(*scene, *frame) : checkOrder(*scene, targets, before));
        HEARTH_ASSIGN_OR_RETURN(const gpu::FrameInput input, makeInput(*scene, targets->targets, *frame));
        (scene->renderer->renderer.get()->*record)(commands, *scene->scene, targets->targets, input);
        if (before == kNothing)
            scene->to_be_recorded = false;
        scene->parts_recorded = after;
        scene->parts_targets = targets;
        targets->scene = scene->scene;
        return success();
    };
    return call(scene->renderer->message(), function, work);
}

Status checkPixels(const hearth_pixels& pixels, VkExtent2D extent)
{
    if (pixels.x >= extent.width || pixels.y >= extent.height || pixels.width > extent.width - pixels.x ||
        pixels.height > extent.height - pixels.y)
        return usage("the pixels are not all inside of the targets");
    const uint64_t count = uint64_t{pixels.width} * pixels.height;
    if (count == 0 || count > shared::kMaxPicks)
        return usage(std::to_string(count) + " pixels are not from 1 to " +
                     std::to_string(shared::kMaxPicks));
    return success();
}

} // namespace

hearth_result hearth_record_frame(hearth_scene* scene, hearth_targets* targets, VkCommandBuffer commands,
                                  const hearth_frame* frame)
{
    return recordParts(__func__, kNothing, kNothing, &gpu::Renderer::record, scene, targets, commands, frame);
}

hearth_result hearth_record_cull(hearth_scene* scene, hearth_targets* targets, VkCommandBuffer commands,
                                 const hearth_frame* frame)
{
    return recordParts(__func__, kNothing, kCulled, &gpu::Renderer::recordCull, scene, targets, commands,
                       frame);
}

hearth_result hearth_record_visibility(hearth_scene* scene, hearth_targets* targets, VkCommandBuffer commands,
                                       const hearth_frame* frame)
{
    return recordParts(__func__, kCulled, kVisible, &gpu::Renderer::recordVisibility, scene, targets,
                       commands, frame);
}

hearth_result hearth_record_materials(hearth_scene* scene, hearth_targets* targets, VkCommandBuffer commands,
                                      const hearth_frame* frame)
{
    return recordParts(__func__, kVisible, kNothing, &gpu::Renderer::recordMaterials, scene, targets,
                       commands, frame);
}

hearth_result hearth_record_missing(hearth_scene* scene, hearth_targets* targets, VkCommandBuffer commands)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(scene->renderer->message(), __func__,
                [&]() -> Status
                {
                    if (targets == nullptr || commands == VK_NULL_HANDLE)
                        return usage("targets or commands is NULL");
                    if (targets->scene.lock() != scene->scene || scene->parts_recorded != kNothing)
                        return usage("no whole frame of the scene has been recorded with the targets");
                    if (!targets->targets.options().counts_missing)
                        return usage("the targets lack HEARTH_TARGETS_COUNT_MISSING");
                    scene->renderer->renderer->recordMissing(commands, *scene->scene, targets->targets);
                    return success();
                });
}

hearth_result hearth_describe_passes(const hearth_scene* scene, const hearth_targets* targets,
                                     const hearth_frame* frame, char* json, size_t size, size_t* needed)
{
    if (scene == nullptr || targets == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(scene->renderer->message(), __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkFrame(*scene, *targets, frame));
                    if (needed == nullptr || (json == nullptr && size > 0))
                        return usage("needed is NULL, or json is NULL and size is not 0");
                    HEARTH_ASSIGN_OR_RETURN(const shared::FrameView view,
                                            makeView(*scene, targets->targets, *frame));
                    const gpu::FrameInput input{
                        .view = view,
                        .shading = {.debug_view = frame->debug_view,
                                    .area = static_cast<gpu::ShadedArea>(frame->shaded_area),
                                    .gi = frame->constant_sky == 0,
                                    .light_lister = static_cast<gpu::LightLister>(frame->light_lists)},
                        .occludes_by_last_frame = frame->occlusion == HEARTH_OCCLUSION_LAST_FRAME};
                    const std::string text = gpu::formatFrameJson(
                        scene->renderer->renderer->describe(*scene->scene, targets->targets, input));
                    *needed = text.size() + 1;
                    if (size > 0)
                        json[text.copy(json, size - 1)] = '\0';
                    return success();
                });
}

hearth_result hearth_record_prefetch(hearth_scene* scene, hearth_targets* targets, VkCommandBuffer commands,
                                     const hearth_frame* frame)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(
        scene->renderer->message(), __func__,
        [&]() -> Status
        {
            HEARTH_TRY(checkCall(*scene, targets, commands, frame));
            HEARTH_TRY(checkFrameBegun(*scene));
            if (scene->scene->stream == nullptr)
                return usage("the scene has no memory_budget: all of it is there");
            HEARTH_ASSIGN_OR_RETURN(const shared::FrameView view, makeView(*scene, targets->targets, *frame));
            scene->renderer->renderer->recordPrefetch(commands, *scene->scene, targets->targets, view);
            scene->to_be_recorded = false;
            scene->parts_recorded = 0;
            return success();
        });
}

hearth_result hearth_record_counters(hearth_scene* scene, VkCommandBuffer commands, VkBuffer destination,
                                     VkDeviceSize offset)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(scene->renderer->message(), __func__,
                [&]() -> Status
                {
                    if (commands == VK_NULL_HANDLE || destination == VK_NULL_HANDLE)
                        return usage("commands or destination is NULL");
                    const gpu::Device& device = scene->renderer->renderer->device();
                    const VkBufferCopy region{0, offset, sizeof(hearth_frame_counters)};
                    device.vk.vkCmdCopyBuffer(commands, scene->scene->frame().main.counters.handle.get(),
                                              destination, 1, &region);
                    gpu::barrier(device, commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                 VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                                 VK_ACCESS_HOST_READ_BIT);
                    return success();
                });
}

hearth_result hearth_record_motion(hearth_scene* scene, hearth_targets* targets, VkCommandBuffer commands)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(scene->renderer->message(), __func__,
                [&]() -> Status
                {
                    if (targets == nullptr || commands == VK_NULL_HANDLE)
                        return usage("targets or commands is NULL");
                    if (!scene->motion)
                        return usage("the scene lacks HEARTH_SCENE_MOTION: upload it with that flag");
                    if (!targets->targets.options().has_motion)
                        return usage("the targets lack HEARTH_TARGETS_MOTION: create them with that flag");
                    if (targets->scene.lock() != scene->scene || scene->parts_recorded != kNothing ||
                        scene->parts_targets != targets)
                        return usage("the scene's last frame is not a whole one with the targets");
                    scene->motion->record(scene->renderer->renderer->device(), commands, *scene->scene,
                                          targets->targets);
                    targets->motion_frame = targets->targets.motion().frame();
                    return success();
                });
}

hearth_result hearth_get_jitter(uint32_t number, uint32_t width, uint32_t height, float* shift_x,
                                float* shift_y, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (shift_x == nullptr || shift_y == nullptr)
                        return usage("shift_x or shift_y is NULL");
                    if (width == 0 || height == 0)
                        return usage("width or height is 0");
                    const Float2 jitter = gpu::jitterShift(number, {width, height});
                    *shift_x = jitter.x;
                    *shift_y = jitter.y;
                    return success();
                });
}

hearth_result hearth_record_anti_aliasing(hearth_scene* scene, hearth_targets* targets,
                                          VkCommandBuffer commands, uint32_t reset)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(scene->renderer->message(), __func__,
                [&]() -> Status
                {
                    if (targets == nullptr || commands == VK_NULL_HANDLE)
                        return usage("targets or commands is NULL");
                    if (reset > 1)
                        return usage("reset is neither 0 nor 1");
                    if (!targets->targets.options().has_temporal_filter)
                        return usage("the targets lack HEARTH_TARGETS_ANTI_ALIASING: create them with that "
                                     "flag");
                    if (targets->scene.lock() != scene->scene || targets->motion_frame == 0 ||
                        targets->motion_frame != targets->targets.motion().frame())
                        return usage(
                            "hearth_record_motion has not been recorded for the targets' last frame");
                    scene->renderer->temporal->record(scene->renderer->renderer->device(), commands,
                                                      targets->targets, reset == 1);
                    return success();
                });
}

hearth_result hearth_record_picks(hearth_scene* scene, hearth_targets* targets, VkCommandBuffer commands,
                                  const hearth_pixels* pixels, VkBuffer destination, VkDeviceSize offset)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(scene->renderer->message(), __func__,
                [&]() -> Status
                {
                    if (targets == nullptr || commands == VK_NULL_HANDLE || pixels == nullptr ||
                        destination == VK_NULL_HANDLE)
                        return usage("targets, commands, pixels or destination is NULL");
                    if (!targets->targets.options().keeps_visibility)
                        return usage(
                            "the targets lack HEARTH_TARGETS_KEEP_VISIBILITY: create them with it, or cast "
                            "a ray (hearth_frame_get_ray)");
                    if (!scene->picks)
                        return usage("hearth_scene_prepare_picks has not prepared the scene");
                    if (targets->scene.lock() != scene->scene || scene->parts_recorded != kNothing)
                        return usage("no whole frame of the scene has been recorded with the targets");
                    HEARTH_TRY(checkPixels(*pixels, targets->targets.extent()));
                    const VkRect2D area{{static_cast<int32_t>(pixels->x), static_cast<int32_t>(pixels->y)},
                                        {pixels->width, pixels->height}};
                    scene->picks->record(scene->renderer->renderer->device(), commands, *scene->scene,
                                         targets->targets, area, destination, offset);
                    return success();
                });
}
