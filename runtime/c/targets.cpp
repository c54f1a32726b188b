// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/handles.h"

using namespace hearth;
using namespace hearth::c;

namespace
{

/// note: must match the dependencies in runtime/gpu/passes/frame_passes.cpp.
hearth_image makeImage(const gpu::Image& image)
{
    return {
        .image = image.handle.get(),
        .format = image.format,
        .before = {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT},
        .after = {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                  VK_ACCESS_TRANSFER_READ_BIT}};
}

} // namespace

hearth_result hearth_targets_create(hearth_renderer* renderer, uint32_t width, uint32_t height,
                                    hearth_targets** targets)
{
    if (renderer == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(renderer->message(), __func__,
                [&]() -> Status
                {
                    if (targets == nullptr)
                        return usage("targets is NULL");
                    if (width == 0 || height == 0)
                        return usage("width or height is 0");
                    HEARTH_ASSIGN_OR_RETURN(gpu::FrameTargets made,
                                            renderer->renderer->createTargets({width, height}));
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
                    *info = {.struct_size = sizeof(*info),
                             .width = targets->targets.extent().width,
                             .height = targets->targets.extent().height,
                             .reserved = 0,
                             .color = makeImage(targets->targets.color()),
                             .visibility = makeImage(targets->targets.visibility()),
                             .allocated_bytes = targets->targets.allocatedBytes()};
                    return success();
                });
}
