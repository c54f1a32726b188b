// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/handles.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <optional>
#include <span>

using namespace hearth;
using namespace hearth::c;

namespace
{

constexpr uint32_t kFeatures = HEARTH_FEATURE_SAMPLER_ANISOTROPY | HEARTH_FEATURE_OVERDRAW |
                               HEARTH_FEATURE_DEBUG_LABELS | HEARTH_FEATURE_GRADING |
                               HEARTH_FEATURE_FINAL_PASS | HEARTH_FEATURE_DEFERRED | HEARTH_FEATURE_ASTC_HDR |
                               HEARTH_FEATURE_RECEIVER_POINTS | HEARTH_FEATURE_DEPTH;

/// Sizes of the description in versions 1.0, and 1.1 to 1.7.
constexpr size_t kOldDescriptionBytes[] = {offsetof(hearth_renderer_description, memory),
                                           offsetof(hearth_renderer_description, frame_way)};

bool supportsVersion(uint32_t version)
{
    return version >> 16 == HEARTH_API_VERSION >> 16 && (version & 0xFFFFu) <= (HEARTH_API_VERSION & 0xFFFFu);
}

/// Return the description of a caller of any version, with defaults for missing members.
Result<hearth_renderer_description> completeDescription(const hearth_renderer_description* caller_description)
{
    const bool is_old = caller_description != nullptr &&
                        std::find(std::begin(kOldDescriptionBytes), std::end(kOldDescriptionBytes),
                                  caller_description->struct_size) != std::end(kOldDescriptionBytes);
    if (!is_old)
        HEARTH_TRY(checkStruct("description", caller_description));
    hearth_renderer_description description = HEARTH_RENDERER_DESCRIPTION_INIT;
    std::memcpy(&description, caller_description, caller_description->struct_size);
    return description;
}

VkFormat colorFormat(const hearth_renderer_description& description)
{
    return description.color_format == VK_FORMAT_UNDEFINED ? gpu::kColorFormat : description.color_format;
}

std::string listColorFormats()
{
    std::string list;
    for (const gpu::ColorFormat& format : gpu::colorFormats())
        list += (list.empty() ? "" : ", ") + std::string(format.name);
    return list;
}

Status check(const hearth_renderer_description& description)
{
    if (!supportsVersion(description.api_version))
        return usage("the caller was compiled for version " + std::to_string(description.api_version >> 16) +
                     "." + std::to_string(description.api_version & 0xFFFFu) + ", the library is " +
                     std::to_string(HEARTH_API_VERSION >> 16) + "." +
                     std::to_string(HEARTH_API_VERSION & 0xFFFFu));
    if (description.get_instance_proc_addr == nullptr || description.instance == VK_NULL_HANDLE ||
        description.physical_device == VK_NULL_HANDLE || description.device == VK_NULL_HANDLE)
        return usage("get_instance_proc_addr, instance, physical_device or device is missing");
    if ((description.features & ~kFeatures) != 0 || description.materials > HEARTH_MATERIALS_ID ||
        description.frame_way > HEARTH_FRAME_ONE_SET)
        return usage("features has bits, or materials or frame_way a value, that this version does not know");
    if (gpu::findColorFormat(colorFormat(description)) == nullptr)
        return usage("color_format is none of " + listColorFormats());
    if ((description.memory.allocate == nullptr) != (description.memory.free == nullptr))
        return usage("memory has one function and not the other");
    return success();
}

VkResult allocateFrom(void* hooks, const gpu::MemoryRequest& request, gpu::MemoryAllocation& piece)
{
    const auto& memory = *static_cast<const hearth_memory_hooks*>(hooks);
    const hearth_memory_request asked{request.needs, static_cast<uint32_t>(request.kind),
                                      request.image ? 1u : 0u};
    hearth_memory_allocation caller_description{};
    const VkResult result = memory.allocate(memory.user, &asked, &caller_description);
    piece = {caller_description.memory, caller_description.offset,
             static_cast<std::byte*>(caller_description.mapped), caller_description.allocation};
    return result;
}

void freeWithHooks(void* hooks, const gpu::MemoryAllocation& piece)
{
    const auto& memory = *static_cast<const hearth_memory_hooks*>(hooks);
    const hearth_memory_allocation caller_description{piece.memory, piece.offset, piece.mapped,
                                                      piece.allocation};
    memory.free(memory.user, &caller_description);
}

gpu::DeviceDescription toDevice(const hearth_renderer_description& description, hearth_memory_hooks& memory)
{
    const auto has = [&](uint32_t feature) { return (description.features & feature) != 0; };
    gpu::DeviceDescription device{.get_instance_proc_addr = description.get_instance_proc_addr,
                                  .instance = description.instance,
                                  .physical_device = description.physical_device,
                                  .device = description.device,
                                  .sampler_anisotropy = has(HEARTH_FEATURE_SAMPLER_ANISOTROPY),
                                  .astc_hdr = has(HEARTH_FEATURE_ASTC_HDR),
                                  .debug_labels = has(HEARTH_FEATURE_DEBUG_LABELS),
                                  .allocator = description.allocator,
                                  .pipeline_cache = description.pipeline_cache,
                                  .message_hook = {description.message_user, description.message}};
    if (memory.allocate != nullptr)
        device.memory_hooks = {&memory, allocateFrom, freeWithHooks};
    return device;
}

std::optional<gpu::FrameWay> toFrameWay(uint32_t way)
{
    switch (way)
    {
    case HEARTH_FRAME_MERGED:
        return gpu::FrameWay::merged;
    case HEARTH_FRAME_SEPARATE:
        return gpu::FrameWay::separate;
    case HEARTH_FRAME_ONE_SET:
        return gpu::FrameWay::one_set;
    default:
        return std::nullopt;
    }
}

/// Copy the tables of the game's material functions.
Result<gpu::MaterialShaders> toMaterialShaders(const hearth_material_shaders& shaders)
{
    if (shaders.functions == nullptr || shaders.motions == nullptr || shaders.modules == nullptr ||
        shaders.version == nullptr)
        return usage("material_shaders has no functions, no motions, no modules or no version");
    gpu::MaterialShaders made{.version = shaders.version};
    for (const hearth_material_function& function : std::span(shaders.functions, shaders.function_count))
        made.functions.push_back(function.name);
    for (const hearth_material_function& motion : std::span(shaders.motions, shaders.motion_count))
        made.motions.push_back(motion.name);
    for (const hearth_material_module& module : std::span(shaders.modules, shaders.module_count))
        made.modules.push_back({module.name, {module.words, module.word_count}});
    return made;
}

gpu::PostSupport toPostSupport(uint32_t features)
{
    if ((features & HEARTH_FEATURE_FINAL_PASS) != 0)
        return gpu::PostSupport::packed;
    return (features & HEARTH_FEATURE_GRADING) != 0 ? gpu::PostSupport::in_tile : gpu::PostSupport::none;
}

Result<std::unique_ptr<hearth_renderer>> create(const hearth_renderer_description& description)
{
    auto made = std::make_unique<hearth_renderer>();
    made->memory = description.memory;
    if (description.material_shaders != nullptr)
    {
        HEARTH_ASSIGN_OR_RETURN(made->material_shaders, toMaterialShaders(*description.material_shaders));
    }
    HEARTH_ASSIGN_OR_RETURN(
        made->renderer,
        gpu::Renderer::create(
            toDevice(description, made->memory),
            {.way = toFrameWay(description.frame_way),
             .materials = static_cast<gpu::MaterialTest>(description.materials),
             .post = toPostSupport(description.features),
             .deferred = (description.features & HEARTH_FEATURE_DEFERRED) != 0,
             .keeps_depth = (description.features & HEARTH_FEATURE_DEPTH) != 0,
             .receiver_update = (description.features & HEARTH_FEATURE_RECEIVER_POINTS) != 0
                                    ? gpu::ReceiverUpdate::points
                                    : gpu::ReceiverUpdate::compute,
             .material_shaders = description.material_shaders != nullptr ? &made->material_shaders : nullptr,
             .color_format = colorFormat(description)}));
    made->shows_overdraw = (description.features & HEARTH_FEATURE_OVERDRAW) != 0;
    if (made->shows_overdraw)
        HEARTH_TRY(made->renderer->prepareOverdraw());
    return made;
}

} // namespace

hearth_result hearth_renderer_create(const hearth_renderer_description* description,
                                     hearth_renderer** renderer, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (renderer == nullptr)
                        return usage("renderer is NULL");
                    HEARTH_ASSIGN_OR_RETURN(const hearth_renderer_description whole,
                                            completeDescription(description));
                    HEARTH_TRY(check(whole));
                    HEARTH_ASSIGN_OR_RETURN(std::unique_ptr<hearth_renderer> made, create(whole));
                    *renderer = made.release();
                    return success();
                });
}

hearth_result hearth_renderer_destroy(hearth_renderer* renderer)
{
    if (renderer == nullptr)
        return HEARTH_OK;
    const hearth_result unused =
        checkUnused(renderer->message(), __func__, "renderer",
                    {{renderer->scene_count, "scene", "scenes"},
                     {renderer->targets_count, "set of targets", "sets of targets"}});
    if (unused == HEARTH_OK)
        delete renderer;
    return unused;
}

const char* hearth_last_error(const hearth_renderer* renderer)
{
    return renderer == nullptr ? "" : renderer->last_error;
}
