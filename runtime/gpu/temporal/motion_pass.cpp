// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/temporal/motion_pass.h"

#include "formats/gpu_shared/decisions.h"
#include "runtime/gpu/vulkan/image_barrier.h"
#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

namespace
{

/// Return the shift of a view's axis, in halves of the image to the right and downwards: of the clip rows
/// only its share lies along the axis.
Float2 axisShift(const shared::FrameView& view)
{
    if (shared::isOrthographic(view))
        return {view.clip_x.w, view.clip_y.w};
    const Float3 axis = shared::row3(view.clip_w);
    return {dot(shared::row3(view.clip_x), axis), dot(shared::row3(view.clip_y), axis)};
}

shared::MotionPush makePush(const Scene& scene, const MotionTargets& targets)
{
    const bool has_earlier = targets.earlierView().has_value();
    const shared::FrameView& now = targets.view();
    const shared::FrameView& then = has_earlier ? *targets.earlierView() : now;
    const bool is_orthographic = shared::isOrthographic(then);
    const Float2 shift = axisShift(now), earlier_shift = is_orthographic ? Float2{} : axisShift(then);
    shared::MotionPush push{.clip_x = then.clip_x,
                            .clip_y = then.clip_y,
                            .clip_w = then.clip_w,
                            .eye = then.eye,
                            .first_instance = 0,
                            .pose_rows = 0,
                            .reserved0 = 0,
                            .reserved1 = 0,
                            .reserved2 = 0};
    push.clip_x.w = earlier_shift.x - shift.x;
    push.clip_y.w = earlier_shift.y - shift.y;
    push.clip_w.w = is_orthographic ? 1.0f : 0.0f;
    if (!has_earlier)
        return push;
    push.first_instance =
        static_cast<uint32_t>(scene.tables->instances.earlierOffset() / sizeof(shared::Instance));
    if (scene.deformation != nullptr)
        push.pose_rows = static_cast<uint32_t>(scene.deformation->table.earlierOffset() / sizeof(Float4));
    return push;
}

} // namespace

Result<MotionPass> MotionPass::create(const Device& device, const DrawLayouts& layouts, const Scene& scene)
{
    HEARTH_ASSERT(scene.tables->keeps_motion);
    MotionPass pass;
    const NumberedSet sets[] = {{shared::kSetScene, layouts.scene.get()},
                                {shared::kSetMotionPixels, layouts.pixels.get()}};
    HEARTH_ASSIGN_OR_RETURN(pass.layout_, createPipelineLayout(device, sets, VK_SHADER_STAGE_FRAGMENT_BIT,
                                                               sizeof(shared::MotionPush)));
    DrawConstants constants{};
    constants[shared::kConstantUsedSlices] = scene.used_slices;
    constants[shared::kConstantDeformed] =
        scene.deformation == nullptr ? shared::kDeformedNone : shared::kDeformedPreSkinned;
    for (const bool has_distances : {false, true})
    {
        UniqueRenderPass& render_pass = pass.render_passes_[has_distances ? 1 : 0];
        HEARTH_ASSIGN_OR_RETURN(render_pass, createMotionRenderPass(device, has_distances));
        HEARTH_ASSIGN_OR_RETURN(
            pass.pipelines_[has_distances ? 1 : 0],
            createGraphicsPipeline(
                device, {.vertex = shaders::post_vert,
                         .fragment = has_distances ? shaders::motion_distances_frag : shaders::motion_frag,
                         .layout = pass.layout_.get(),
                         .render_pass = render_pass.get(),
                         .subpass = 0,
                         .depth_compare = VK_COMPARE_OP_ALWAYS,
                         .depth_write = false,
                         .colors = has_distances ? 2u : 1u,
                         .constants = constants}));
    }
    return pass;
}

void MotionPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                        const FrameTargets& targets) const
{
    HEARTH_ASSERT(targets.options().has_motion && targets.motion().step() != 0);
    const DeviceTable& vk = device.vk;
    constexpr VkPipelineStageFlags kFragments = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
    constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    constexpr VkPipelineStageFlags kTransfer = VK_PIPELINE_STAGE_TRANSFER_BIT;
    // waits for the frame
    transition(device, commands, targets.visibility(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
               VK_ACCESS_SHADER_READ_BIT, VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT | kCompute | kTransfer,
               kFragments);
    barrier(device, commands, kCompute, VK_ACCESS_SHADER_WRITE_BIT, kFragments, VK_ACCESS_SHADER_READ_BIT);

    const VkExtent2D extent = targets.extent();
    const size_t kind = targets.motion().hasDistances() ? 1 : 0;
    VkRenderPassBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    begin.renderPass = render_passes_[kind].get();
    begin.framebuffer = targets.motion().framebuffer();
    begin.renderArea.extent = extent;
    vk.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0, 1};
    const VkRect2D scissor{{0, 0}, extent};
    vk.vkCmdSetViewport(commands, 0, 1, &viewport);
    vk.vkCmdSetScissor(commands, 0, 1, &scissor);
    const VkDescriptorSet sets[] = {scene.frame().main.draw_set, targets.pixelSet()};
    const shared::MotionPush push = makePush(scene, targets.motion());
    vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_[kind].get());
    vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), shared::kSetScene, 2,
                               sets, 0, nullptr);
    vk.vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(push), &push);
    vk.vkCmdDraw(commands, 3, 1, 0, 0);
    vk.vkCmdEndRenderPass(commands);

    transition(device, commands, targets.visibility(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 0, VK_ACCESS_TRANSFER_READ_BIT, kFragments, kTransfer);
}

} // namespace hearth::gpu
