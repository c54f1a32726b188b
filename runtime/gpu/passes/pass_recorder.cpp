// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/pass_recorder.h"

#include "formats/gpu_shared/records.h"
#include "runtime/gpu/frame/frame_plan.h"
#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/vulkan/pipelines.h"

#include <algorithm>

namespace hearth::gpu
{

namespace
{

bool hasStep(const Pass& pass, FrameStep step)
{
    return std::find(pass.steps.begin(), pass.steps.end(), step) != pass.steps.end();
}

/// True if a frame has the step as often as it draws shadow maps, or rounds of them, or levels of bloom.
bool isRepeated(FrameStep step)
{
    return step == FrameStep::shadow_cull || step == FrameStep::shadow_map ||
           step == FrameStep::shadow_copy || step == FrameStep::moving_shadow_map ||
           step == FrameStep::bloom_down || step == FrameStep::bloom_up;
}

/// Return the image that the frame shows among the attachments of a pass; null if it has none.
const AttachmentUse* findColor(const Pass& pass)
{
    const auto found =
        std::find_if(pass.attachments.begin(), pass.attachments.end(),
                     [](const AttachmentUse& use) { return use.resource == FrameResource::color; });
    return found == pass.attachments.end() ? nullptr : &*found;
}

/// Return a barrier that waits for uses of an image of the caller as well, which are over then.
PassBarrier withUses(PassBarrier barrier, const ImageState& before)
{
    barrier.from |= before.stages;
    barrier.written |= before.access;
    barrier.to |= accessStages(Access::color_write);
    barrier.accessed |= accessFlags(Access::color_write);
    return barrier;
}

constexpr size_t kMaxAttachments = 8;

VkClearValue clearValue(FrameResource resource)
{
    VkClearValue value{};
    if (resource == FrameResource::visibility)
        value.color.uint32[0] = shared::kVisibilitySky;
    else if (resource == FrameResource::depth || resource == FrameResource::shadow_map)
        value.depthStencil = {0, 0}; // at infinity
    else if (resource == FrameResource::color || resource == FrameResource::radiance)
        value.color = {.float32 = {0, 0, 0, 1}};
    return value;
}

} // namespace

void PassRecorder::begin(FrameStep step)
{
    if (open_ == nullptr || !hasStep(*open_, step) || isRepeated(step))
    {
        end();
        const size_t number = findNext(step);
        beginPass(number);
        const PlannedPass& planned = plan_.render_passes[number];
        if (open_->kind == PassKind::render)
            beginRenderPass(targets_.leavingPass(planned.render_pass), targets_.framebuffer(planned.family),
                            targets_.framebufferExtent(planned.family));
    }
    while (open_->kind == PassKind::render &&
           (open_->subpasses[subpass_].step != step || open_->subpasses[subpass_].is_empty))
        nextSubpass();
}

void PassRecorder::begin(FrameStep step, VkFramebuffer framebuffer, VkExtent2D extent)
{
    end();
    const size_t number = findNext(step);
    beginPass(number);
    HEARTH_ASSERT(hasOwnSize(*open_));
    beginRenderPass(plan_.render_passes[number].render_pass, framebuffer, extent);
}

void PassRecorder::end()
{
    if (open_ != nullptr && open_->kind == PassKind::render)
    {
        while (subpass_ + 1 < open_->subpasses.size())
        {
            nextSubpass();
            HEARTH_ASSERT(open_->subpasses[subpass_].is_empty); // nothing described is left out
        }
        device_.vk.vkCmdEndRenderPass(commands_);
    }
    if (open_ != nullptr)
    {
        for (const LayoutChange& change : open_->handed_out)
            handOut(change);
        wait(open_->vertex_barrier);
        handOutColor();
    }
    open_ = nullptr;
}

bool PassRecorder::has(FrameStep step) const
{
    return findPass(plan_.description, step) != nullptr;
}

ShadedOutput PassRecorder::shadedOutput() const
{
    const FrameConfiguration& c = plan_.description.configuration;
    return gpu::shadedOutput(c.light_path, c.has_final_pass);
}

bool PassRecorder::sharesPass(FrameStep first, FrameStep second) const
{
    const Pass* pass = findPass(plan_.description, first);
    return pass != nullptr && pass == findPass(plan_.description, second);
}

/// Return the number of the next pass that has a step. After the plan's last shadow map come more like it.
size_t PassRecorder::findNext(FrameStep step) const
{
    const auto& passes = plan_.description.passes;
    for (size_t number = passes_begun_; number < passes.size(); ++number)
        if (hasStep(passes[number], step))
            return number;
    for (size_t number = passes_begun_; number-- > 0;)
        if (hasStep(passes[number], step) && isRepeated(step))
            return number;
    HEARTH_ASSERT(false); // the step is described, after those that were recorded
    return 0;
}

void PassRecorder::beginPass(size_t number)
{
    open_ = &plan_.description.passes[number];
    passes_begun_ = number + 1;
    subpass_ = 0;
    wait(open_->barrier);
    const CallerImages& colors = targets_.options().colors;
    wait(!colors.images.empty() && findColor(*open_) != nullptr
             ? withUses(open_->fragment_barrier, colors.before)
             : open_->fragment_barrier);
}

void PassRecorder::wait(const PassBarrier& described) const
{
    if (described.from != 0)
        barrier(device_, commands_, described.from, described.written, described.to, described.accessed);
}

void PassRecorder::beginRenderPass(VkRenderPass render_pass, VkFramebuffer framebuffer, VkExtent2D extent)
{
    const VkRect2D area{{0, 0}, extent};
    VkClearValue clear[kMaxAttachments] = {};
    const auto attachment_count = static_cast<uint32_t>(open_->attachments.size());
    HEARTH_ASSERT(attachment_count <= kMaxAttachments);
    for (uint32_t i = 0; i < attachment_count; ++i)
        clear[i] = clearValue(open_->attachments[i].resource);
    VkRenderPassBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    begin.renderPass = render_pass;
    begin.framebuffer = framebuffer;
    begin.renderArea = area;
    begin.clearValueCount = attachment_count;
    begin.pClearValues = clear;
    device_.vk.vkCmdBeginRenderPass(commands_, &begin, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport{
        0, 0, static_cast<float>(area.extent.width), static_cast<float>(area.extent.height), 0, 1};
    device_.vk.vkCmdSetViewport(commands_, 0, 1, &viewport);
    device_.vk.vkCmdSetScissor(commands_, 0, 1, &area);
}

/// Change the layout of an image that the pass has read.
void PassRecorder::handOut(const LayoutChange& change)
{
    HEARTH_ASSERT(change.resource == FrameResource::visibility);
    VkImageMemoryBarrier image{};
    image.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    image.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
    image.oldLayout = change.from;
    image.newLayout = change.to;
    image.srcQueueFamilyIndex = image.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    image.image = targets_.visibility().handle.get();
    image.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    device_.vk.vkCmdPipelineBarrier(commands_, accessStages(Access::fragment_read),
                                    VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 1, &image);
}

/// Show an image of the caller, which the pass has left in its layout, to the caller's uses.
void PassRecorder::handOutColor() const
{
    const CallerImages& colors = targets_.options().colors;
    const AttachmentUse* color = findColor(*open_);
    if (colors.images.empty() || colors.after.stages == 0 || color == nullptr || !color->store)
        return;
    // dependencies of render passes end in the stage of copies, and have to be the same for all of a family
    barrier(device_, commands_, accessStages(Access::color_write) | VK_PIPELINE_STAGE_TRANSFER_BIT,
            accessFlags(Access::color_write), colors.after.stages, colors.after.access);
}

void PassRecorder::nextSubpass()
{
    HEARTH_ASSERT(subpass_ + 1 < open_->subpasses.size());
    ++subpass_;
    device_.vk.vkCmdNextSubpass(commands_, VK_SUBPASS_CONTENTS_INLINE);
}

} // namespace hearth::gpu
