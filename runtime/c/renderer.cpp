// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/handles.h"

using namespace hearth;
using namespace hearth::c;

namespace
{

constexpr uint32_t kFeatures = HEARTH_FEATURE_SAMPLER_ANISOTROPY | HEARTH_FEATURE_OVERDRAW;

bool understands(uint32_t version)
{
    return version >> 16 == HEARTH_API_VERSION >> 16 && (version & 0xFFFFu) <= (HEARTH_API_VERSION & 0xFFFFu);
}

Status check(const hearth_renderer_description* description)
{
    HEARTH_TRY(checkStruct("description", description));
    if (!understands(description->api_version))
        return usage("the caller was compiled for version " + std::to_string(description->api_version >> 16) +
                     "." + std::to_string(description->api_version & 0xFFFFu) + ", the library is " +
                     std::to_string(HEARTH_API_VERSION >> 16) + "." +
                     std::to_string(HEARTH_API_VERSION & 0xFFFFu));
    if (description->get_instance_proc_addr == nullptr || description->instance == VK_NULL_HANDLE ||
        description->physical_device == VK_NULL_HANDLE || description->device == VK_NULL_HANDLE)
        return usage("get_instance_proc_addr, instance, physical_device or device is missing");
    if ((description->features & ~kFeatures) != 0 || description->reserved != 0)
        return usage("features has bits that this version does not know, or reserved is not 0");
    return success();
}

Result<std::unique_ptr<hearth_renderer>> create(const hearth_renderer_description& description)
{
    auto made = std::make_unique<hearth_renderer>();
    const bool anisotropy = (description.features & HEARTH_FEATURE_SAMPLER_ANISOTROPY) != 0;
    HEARTH_ASSIGN_OR_RETURN(
        made->renderer, gpu::Renderer::create({.get_instance_proc_addr = description.get_instance_proc_addr,
                                               .instance = description.instance,
                                               .physical_device = description.physical_device,
                                               .device = description.device,
                                               .sampler_anisotropy = anisotropy,
                                               .allocator = description.allocator,
                                               .pipeline_cache = description.pipeline_cache}));
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
                    HEARTH_TRY(check(description));
                    HEARTH_ASSIGN_OR_RETURN(std::unique_ptr<hearth_renderer> made, create(*description));
                    *renderer = made.release();
                    return success();
                });
}

hearth_result hearth_renderer_destroy(hearth_renderer* renderer)
{
    if (renderer != nullptr && renderer->child_count != 0)
        return HEARTH_ERROR_IN_USE;
    delete renderer;
    return HEARTH_OK;
}

const char* hearth_last_error(const hearth_renderer* renderer)
{
    return renderer == nullptr ? "" : renderer->last_error;
}
