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

constexpr size_t kMaxAttachments = 3;

VkClearValue clearValue(FrameResource resource)
{
    VkClearValue value{};
    if (resource == FrameResource::visibility)
        value.color.uint32[0] = shared::kVisibilitySky;
    else if (resource == FrameResource::depth)
        value.depthStencil = {0, 0}; // at infinity
    else
        value.color = {.float32 = {0, 0, 0, 1}};
    return value;
}

} // namespace

void PassRecorder::begin(FrameStep step)
{
    if (open_ == nullptr || !hasStep(*open_, step))
    {
        end();
        const auto& passes = plan_.description.passes;
        size_t number = passes_begun_;
        while (number < passes.size() && !hasStep(passes[number], step))
            ++number;
        HEARTH_ASSERT(number < passes.size()); // the step is described, after those that were recorded
        beginPass(number);
    }
    while (open_->kind == PassKind::render &&
           (open_->subpasses[subpass_].step != step || open_->subpasses[subpass_].is_empty))
        nextSubpass();
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
        for (const LayoutChange& change : open_->handed_out)
            handOut(change);
    open_ = nullptr;
}

bool PassRecorder::has(FrameStep step) const
{
    return findPass(plan_.description, step) != nullptr;
}

bool PassRecorder::sharesPass(FrameStep first, FrameStep second) const
{
    const Pass* pass = findPass(plan_.description, first);
    return pass != nullptr && pass == findPass(plan_.description, second);
}

void PassRecorder::beginPass(size_t number)
{
    open_ = &plan_.description.passes[number];
    passes_begun_ = number + 1;
    subpass_ = 0;
    const PassBarrier& wait = open_->barrier;
    if (wait.from != 0)
        barrier(device_, commands_, wait.from, wait.written, wait.to, wait.accessed);
    if (open_->kind != PassKind::render)
        return;

    const VkRect2D area{{0, 0}, targets_.extent()};
    VkClearValue clear[kMaxAttachments] = {};
    const auto attachment_count = static_cast<uint32_t>(open_->attachments.size());
    HEARTH_ASSERT(attachment_count <= kMaxAttachments);
    for (uint32_t i = 0; i < attachment_count; ++i)
        clear[i] = clearValue(open_->attachments[i].resource);
    VkRenderPassBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    begin.renderPass = plan_.render_passes[number].render_pass;
    begin.framebuffer = targets_.framebuffer(plan_.render_passes[number].family);
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

void PassRecorder::nextSubpass()
{
    HEARTH_ASSERT(subpass_ + 1 < open_->subpasses.size());
    ++subpass_;
    device_.vk.vkCmdNextSubpass(commands_, VK_SUBPASS_CONTENTS_INLINE);
}

} // namespace hearth::gpu
