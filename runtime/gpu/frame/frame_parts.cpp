// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/frame/frame_parts.h"

#include "formats/base/assert.h"
#include "runtime/gpu/frame/frame_plan.h"

namespace hearth::gpu
{

namespace
{

ImageUse imageUse(const Pass& pass, FrameResource resource)
{
    for (const AttachmentUse& use : pass.attachments)
        if (use.resource == resource)
        {
            // a pass that neither loads nor stores leaves the image alone, but for its content
            if (use.load == LoadOperation::none && !use.store)
                return {};
            const ImageState before{use.initial_layout, kCallerStages, kCallerReads};
            if (!use.store)
                return {before, {VK_IMAGE_LAYOUT_UNDEFINED, kCallerStages, 0}};
            return {before, {use.final_layout, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT}};
        }
    return {};
}

} // namespace

PartImages partImages(FramePart part, bool keeps_visibility)
{
    if (part == FramePart::cull)
        return {};
    const FrameDescription frame = describeFrame({.in_parts = true, .keeps_visibility = keeps_visibility});
    const FrameStep step = part == FramePart::visibility ? FrameStep::visibility : FrameStep::shading;
    const Pass* pass = findPass(frame, step);
    HEARTH_ASSERT(pass != nullptr);
    PartImages images{imageUse(*pass, FrameResource::visibility), imageUse(*pass, FrameResource::color)};
    // earlier passes of the part begin with nothing
    if (part == FramePart::visibility)
        images.visibility.before.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    return images;
}

} // namespace hearth::gpu
