// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/shadows.h"
#include "runtime/gpu/scene/scene_shadows.h"
#include "runtime/gpu/textures/streamed_textures.h"

#include <array>
#include <bit>
#include <cstring>

using namespace hearth;
using namespace hearth::c;

namespace
{

constexpr uint32_t kMaxLoads = 1024;

using HearthReadBytes = std::array<unsigned char, sizeof(pack::ReadDone)>;
static_assert(sizeof(pack::ReadDone) <= sizeof(hearth_page_read));

hearth_page_read toC(const pack::ReadDone& done)
{
    hearth_page_read read{};
    std::memcpy(read.internal, &done, sizeof(done));
    return read;
}

pack::ReadDone fromC(const hearth_page_read& read)
{
    HearthReadBytes bytes;
    std::memcpy(bytes.data(), read.internal, bytes.size());
    return std::bit_cast<pack::ReadDone>(bytes);
}

Status check(const hearth_scene_options* options)
{
    HEARTH_TRY(checkStruct("options", options));
    if (options->max_visible_clusters < 1 || options->max_visible_clusters > shared::kMaxSlots)
        return usage("max_visible_clusters is not from 1 to " + std::to_string(shared::kMaxSlots));
    if (options->frames_in_flight < 1 || options->frames_in_flight > gpu::kMaxFramesInFlight)
        return usage("frames_in_flight is not from 1 to " + std::to_string(gpu::kMaxFramesInFlight));
    if (options->max_lights > shared::kMaxLights ||
        (options->flags & ~uint32_t{HEARTH_SCENE_DECODE_TEXTURES | HEARTH_SCENE_MOTION}) != 0)
        return usage("max_lights is above " + std::to_string(shared::kMaxLights) +
                     ", or flags have a bit that does not exist");
    if (options->memory_budget == 0)
        return success();
    if (options->read == nullptr)
        return usage("memory_budget needs a read callback");
    if (options->max_loads < 1 || options->max_loads > kMaxLoads)
        return usage("max_loads is not from 1 to " + std::to_string(kMaxLoads));
    return success();
}

Result<gpu::SceneOptions> toOptions(const hearth_scene_options& options)
{
    gpu::SceneOptions result{.max_visible_clusters = options.max_visible_clusters,
                             .frames_in_flight = options.frames_in_flight,
                             .memory_budget = options.memory_budget};
    if (options.memory_budget > 0)
        result.stream = {.read = [read = options.read, user = options.read_user](
                                     uint32_t page, std::span<std::byte> destination, pack::ReadDone done)
                         { read(user, page, destination.data(), destination.size(), toC(done)); },
                         .max_loads = options.max_loads};
    result.deformation.scratch_bytes = options.skinning_bytes;
    result.max_lights = options.max_lights;
    result.decode_textures = (options.flags & HEARTH_SCENE_DECODE_TEXTURES) != 0;
    result.keeps_motion = (options.flags & HEARTH_SCENE_MOTION) != 0;
    HEARTH_ASSIGN_OR_RETURN(result.shadows, shadowOptions(options.shadows));
    return result;
}

Status createMotion(hearth_scene& handle)
{
    if (!handle.scene->tables->keeps_motion)
        return success();
    const gpu::Renderer& renderer = *handle.renderer->renderer;
    HEARTH_ASSIGN_OR_RETURN(gpu::MotionPass made,
                            gpu::MotionPass::create(renderer.device(), renderer.layouts(), *handle.scene));
    handle.motion.emplace(std::move(made));
    return success();
}

Status checkStreamed(const hearth_scene& scene)
{
    return scene.scene->stream == nullptr ? Status(usage("the scene has no memory_budget")) : success();
}

Status checkSerials(const hearth_scene& scene, uint64_t serial, uint64_t completed_serial)
{
    if (scene.to_be_recorded)
        return usage("frame " + std::to_string(scene.serial) + " has not been recorded");
    if (serial <= scene.serial)
        return usage("serial " + std::to_string(serial) + " is not above " + std::to_string(scene.serial) +
                     ", that of the frame before");
    if (completed_serial >= serial)
        return usage("completed_serial " + std::to_string(completed_serial) + " is not below serial " +
                     std::to_string(serial));
    if (completed_serial < scene.completed_serial)
        return usage("completed_serial fell from " + std::to_string(scene.completed_serial) + " to " +
                     std::to_string(completed_serial));
    return success();
}

uint64_t allocatedBytes(const hearth_scene& handle)
{
    const gpu::Scene& scene = *handle.scene;
    return (handle.picks ? handle.picks->allocatedBytes() : 0) + scene.arena.allocatedBytes() +
           (scene.stream == nullptr ? 0 : scene.stream->allocatedBytes()) +
           (scene.shadows == nullptr ? 0 : scene.shadows->allocatedBytes());
}

} // namespace

void hearth_read_done(hearth_page_read read, int ok)
{
    fromC(read)(ok != 0);
}

hearth_result hearth_scene_upload(hearth_renderer* renderer, hearth_pack* pack, VkCommandBuffer commands,
                                  const hearth_scene_options* options, hearth_scene** scene)
{
    if (renderer == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(renderer->message(), __func__,
                [&]() -> Status
                {
                    if (pack == nullptr || commands == VK_NULL_HANDLE || scene == nullptr)
                        return usage("pack, commands or scene is NULL");
                    HEARTH_TRY(check(options));
                    HEARTH_ASSIGN_OR_RETURN(const gpu::SceneOptions scene_options, toOptions(*options));
                    auto made = std::make_unique<hearth_scene>();
                    made->renderer = renderer;
                    made->pack = pack;
                    HEARTH_ASSIGN_OR_RETURN(
                        made->scene, renderer->renderer->upload(pack->pack.view(), commands, scene_options));
                    HEARTH_TRY(createMotion(*made));
                    ++renderer->scene_count;
                    ++pack->scene_count;
                    *scene = made.release();
                    return success();
                });
}

hearth_result hearth_scene_prepare_lights(hearth_scene* scene, uint32_t method)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(scene->renderer->message(), __func__,
                [&]() -> Status
                {
                    if (method >= gpu::kLightMethodCount)
                        return usage("method is unknown to this version");
                    if (!scene->renderer->renderer->supports(static_cast<gpu::LightMethod>(method)))
                        return usage("the method needs a renderer with HEARTH_FEATURE_DEFERRED");
                    HEARTH_TRY(scene->renderer->renderer->prepareLightMethod(
                        *scene->scene, static_cast<gpu::LightMethod>(method)));
                    scene->prepared_lights |= 1u << method;
                    return success();
                });
}

hearth_result hearth_scene_prepare_picks(hearth_scene* scene)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(scene->renderer->message(), __func__,
                [&]() -> Status
                {
                    if (scene->picks)
                        return success();
                    const gpu::Renderer& renderer = *scene->renderer->renderer;
                    HEARTH_ASSIGN_OR_RETURN(
                        gpu::PickPass made,
                        gpu::PickPass::create(renderer.device(), renderer.layouts(), *scene->scene));
                    scene->picks.emplace(std::move(made));
                    return success();
                });
}

hearth_result hearth_scene_release_staging(hearth_scene* scene)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    scene->scene->staging.reset();
    return HEARTH_OK;
}

hearth_result hearth_scene_destroy(hearth_scene* scene)
{
    if (scene == nullptr)
        return HEARTH_OK;
    const std::unique_ptr<hearth_scene> dying(scene);
    scene->scene.reset(); // uses the pack, so it goes first
    --scene->renderer->scene_count;
    --scene->pack->scene_count;
    return HEARTH_OK;
}

hearth_result hearth_scene_get_info(const hearth_scene* scene, hearth_scene_info* info)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(scene->renderer->message(), __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkStruct("info", info));
                    const Box3& box = scene->scene->bounds;
                    *info = {.struct_size = sizeof(*info),
                             .instance_count = scene->scene->instance_count,
                             .dropped_lights = scene->scene->dropped_lights,
                             .decoded_textures = scene->scene->decoded_textures,
                             .box_min = {box.min.x, box.min.y, box.min.z},
                             .box_max = {box.max.x, box.max.y, box.max.z},
                             .allocated_bytes = allocatedBytes(*scene)};
                    return success();
                });
}

hearth_result hearth_scene_begin_frame(hearth_scene* scene, uint64_t serial, uint64_t completed_serial)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(scene->renderer->message(), __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkStreamed(*scene));
                    HEARTH_TRY(checkSerials(*scene, serial, completed_serial));
                    scene->serial = serial;
                    scene->completed_serial = completed_serial;
                    scene->to_be_recorded = true;
                    scene->scene->stream->beginFrame(serial, completed_serial);
                    return success();
                });
}

hearth_result hearth_scene_get_stream_counters(const hearth_scene* scene, hearth_stream_counters* counters)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(scene->renderer->message(), __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkStreamed(*scene));
                    HEARTH_TRY(checkStruct("counters", counters));
                    const gpu::SceneStream& stream = *scene->scene->stream;
                    const pack::StreamStatistics& now = stream.statistics();
                    *counters = {.struct_size = sizeof(*counters),
                                 .error_scale = now.error_scale,
                                 .budget_bytes = now.budget_bytes,
                                 .bytes_in_use = now.bytes_in_use,
                                 .bytes_resident = now.bytes_resident,
                                 .bytes_streamed = now.bytes_streamed,
                                 .settled_serial = stream.settledSerial(),
                                 .pages_resident = now.pages_resident,
                                 .reads_in_flight = stream.pages().readsInFlight(),
                                 .failures = now.failures,
                                 .failed_page_count = static_cast<uint32_t>(stream.failed().size()),
                                 .failed_pages = stream.failed().data(),
                                 .texture_error_scale = 1};
                    if (stream.textures() != nullptr)
                    {
                        const gpu::TextureStatistics textures = stream.textures()->statistics();
                        counters->texture_budget_bytes = textures.budget_bytes;
                        counters->texture_bytes_in_use = textures.bytes_in_use;
                        counters->texture_bytes_on_device = textures.bytes_on_device;
                        counters->texture_bytes_streamed = textures.bytes_streamed;
                        counters->texture_failures = textures.failures;
                        counters->texture_error_scale = textures.error_scale;
                    }
                    return success();
                });
}

hearth_result hearth_scene_retry_failed(hearth_scene* scene)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(scene->renderer->message(), __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkStreamed(*scene));
                    scene->scene->stream->retryFailed();
                    return success();
                });
}
