// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/frame/stage_spy.h"

#include "tests/runtime/gpu/replace_function.h"

#include <map>
#include <string_view>

namespace hearth::test
{

namespace
{

// in the order in which the stages of a command run
constexpr VkPipelineStageFlags kStageOrder[] = {VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT,
                                                VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                                VK_PIPELINE_STAGE_TRANSFER_BIT,
                                                VK_PIPELINE_STAGE_VERTEX_SHADER_BIT,
                                                VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT,
                                                VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
                                                VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT,
                                                VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT};

constexpr VkPipelineStageFlags kFragmentStages =
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT |
    VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
constexpr VkPipelineStageFlags kDrawStages = VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | kFragmentStages;

struct Spy
{
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    PFN_vkGetDeviceProcAddr get_device_proc_addr = nullptr;
    PFN_vkCreateRenderPass create_render_pass = nullptr;
    PFN_vkCmdPipelineBarrier pipeline_barrier = nullptr;
    PFN_vkCmdBeginRenderPass begin_render_pass = nullptr;
    PFN_vkCmdNextSubpass next_subpass = nullptr;
    PFN_vkCmdEndRenderPass end_render_pass = nullptr;
    PFN_vkCmdDraw draw = nullptr;
    PFN_vkCmdDrawIndirect draw_indirect = nullptr;
    PFN_vkCmdDispatch dispatch = nullptr;
    PFN_vkCmdDispatchIndirect dispatch_indirect = nullptr;
    PFN_vkCmdCopyBuffer copy_buffer = nullptr;
    PFN_vkCmdCopyImage copy_image = nullptr;
    PFN_vkCmdUpdateBuffer update_buffer = nullptr;
    PFN_vkCmdFillBuffer fill_buffer = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT begin_label = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT end_label = nullptr;

    std::map<VkRenderPass, std::vector<VkSubpassDependency>> dependencies;
    VkRenderPass open = VK_NULL_HANDLE;
    uint32_t subpass = 0;
    std::vector<std::string> labels;
    std::string marked;
    VkPipelineStageFlags done = 0; ///< stages whose work so far includes marked fragments, or waits for them
    VkPipelineStageFlags waiting = 0; ///< stages whose further work waits for marked fragments
    std::vector<SpiedCommand> commands;

    static VkPipelineStageFlags expand(VkPipelineStageFlags stages)
    {
        constexpr VkPipelineStageFlags kAll =
            VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT;
        return (stages & kAll) != 0 ? ~VkPipelineStageFlags{0} : stages;
    }

    void barrier(VkPipelineStageFlags from, VkPipelineStageFlags to)
    {
        if ((done & expand(from)) != 0)
            waiting |= expand(to);
    }

    void command(VkPipelineStageFlags stages)
    {
        const std::string label = labels.empty() ? "" : labels.back();
        SpiedCommand spied{label, stages, 0};
        for (const VkPipelineStageFlags stage : kStageOrder)
        {
            if ((stages & stage) == 0)
                continue;
            // a stage waits with the stages before it
            if ((waiting & stage) != 0 || spied.waiting != 0)
                spied.waiting |= stage;
        }
        done |= spied.waiting;
        if (!marked.empty() && label == marked)
            done |= stages & kFragmentStages;
        commands.push_back(std::move(spied));
    }

    void depend(uint32_t from, uint32_t to)
    {
        for (const VkSubpassDependency& dependency : dependencies[open])
            if (dependency.srcSubpass == from && dependency.dstSubpass == to)
                barrier(dependency.srcStageMask, dependency.dstStageMask);
    }
};

Spy spy;

VKAPI_ATTR VkResult VKAPI_CALL createRenderPass(VkDevice device, const VkRenderPassCreateInfo* info,
                                                const VkAllocationCallbacks* allocator, VkRenderPass* pass)
{
    const VkResult result = spy.create_render_pass(device, info, allocator, pass);
    spy.dependencies[*pass].assign(info->pDependencies, info->pDependencies + info->dependencyCount);
    return result;
}

VKAPI_ATTR void VKAPI_CALL pipelineBarrier(VkCommandBuffer commands, VkPipelineStageFlags from,
                                           VkPipelineStageFlags to, VkDependencyFlags flags, uint32_t a,
                                           const VkMemoryBarrier* memory, uint32_t b,
                                           const VkBufferMemoryBarrier* buffers, uint32_t c,
                                           const VkImageMemoryBarrier* images)
{
    spy.barrier(from, to);
    spy.pipeline_barrier(commands, from, to, flags, a, memory, b, buffers, c, images);
}

VKAPI_ATTR void VKAPI_CALL beginRenderPass(VkCommandBuffer commands, const VkRenderPassBeginInfo* info,
                                           VkSubpassContents contents)
{
    spy.open = info->renderPass;
    spy.subpass = 0;
    spy.depend(VK_SUBPASS_EXTERNAL, 0);
    spy.begin_render_pass(commands, info, contents);
}

VKAPI_ATTR void VKAPI_CALL nextSubpass(VkCommandBuffer commands, VkSubpassContents contents)
{
    spy.depend(spy.subpass, spy.subpass + 1);
    ++spy.subpass;
    spy.depend(VK_SUBPASS_EXTERNAL, spy.subpass);
    spy.next_subpass(commands, contents);
}

VKAPI_ATTR void VKAPI_CALL endRenderPass(VkCommandBuffer commands)
{
    for (uint32_t subpass = 0; subpass <= spy.subpass; ++subpass)
        spy.depend(subpass, VK_SUBPASS_EXTERNAL);
    spy.end_render_pass(commands);
}

VKAPI_ATTR void VKAPI_CALL draw(VkCommandBuffer commands, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    spy.command(kDrawStages);
    spy.draw(commands, a, b, c, d);
}

VKAPI_ATTR void VKAPI_CALL drawIndirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset,
                                        uint32_t count, uint32_t stride)
{
    spy.command(kDrawStages | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT);
    spy.draw_indirect(commands, buffer, offset, count, stride);
}

VKAPI_ATTR void VKAPI_CALL dispatch(VkCommandBuffer commands, uint32_t x, uint32_t y, uint32_t z)
{
    spy.command(VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
    spy.dispatch(commands, x, y, z);
}

VKAPI_ATTR void VKAPI_CALL dispatchIndirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset)
{
    spy.command(VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT);
    spy.dispatch_indirect(commands, buffer, offset);
}

VKAPI_ATTR void VKAPI_CALL copyBuffer(VkCommandBuffer commands, VkBuffer from, VkBuffer to, uint32_t count,
                                      const VkBufferCopy* regions)
{
    spy.command(VK_PIPELINE_STAGE_TRANSFER_BIT);
    spy.copy_buffer(commands, from, to, count, regions);
}

VKAPI_ATTR void VKAPI_CALL copyImage(VkCommandBuffer commands, VkImage from, VkImageLayout a, VkImage to,
                                     VkImageLayout b, uint32_t count, const VkImageCopy* regions)
{
    spy.command(VK_PIPELINE_STAGE_TRANSFER_BIT);
    spy.copy_image(commands, from, a, to, b, count, regions);
}

VKAPI_ATTR void VKAPI_CALL updateBuffer(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset,
                                        VkDeviceSize size, const void* data)
{
    spy.command(VK_PIPELINE_STAGE_TRANSFER_BIT);
    spy.update_buffer(commands, buffer, offset, size, data);
}

VKAPI_ATTR void VKAPI_CALL fillBuffer(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset,
                                      VkDeviceSize size, uint32_t data)
{
    spy.command(VK_PIPELINE_STAGE_TRANSFER_BIT);
    spy.fill_buffer(commands, buffer, offset, size, data);
}

VKAPI_ATTR void VKAPI_CALL beginLabel(VkCommandBuffer commands, const VkDebugUtilsLabelEXT* label)
{
    spy.labels.emplace_back(label->pLabelName);
    spy.begin_label(commands, label);
}

VKAPI_ATTR void VKAPI_CALL endLabel(VkCommandBuffer commands)
{
    spy.labels.pop_back();
    spy.end_label(commands);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name)
{
    const PFN_vkVoidFunction function = spy.get_device_proc_addr(device, name);
    const std::string_view which = name;
    if (which == "vkCreateRenderPass")
        return replaceFunction(function, spy.create_render_pass, createRenderPass);
    if (which == "vkCmdPipelineBarrier")
        return replaceFunction(function, spy.pipeline_barrier, pipelineBarrier);
    if (which == "vkCmdBeginRenderPass")
        return replaceFunction(function, spy.begin_render_pass, beginRenderPass);
    if (which == "vkCmdNextSubpass")
        return replaceFunction(function, spy.next_subpass, nextSubpass);
    if (which == "vkCmdEndRenderPass")
        return replaceFunction(function, spy.end_render_pass, endRenderPass);
    if (which == "vkCmdDraw")
        return replaceFunction(function, spy.draw, draw);
    if (which == "vkCmdDrawIndirect")
        return replaceFunction(function, spy.draw_indirect, drawIndirect);
    if (which == "vkCmdDispatch")
        return replaceFunction(function, spy.dispatch, dispatch);
    if (which == "vkCmdDispatchIndirect")
        return replaceFunction(function, spy.dispatch_indirect, dispatchIndirect);
    if (which == "vkCmdCopyBuffer")
        return replaceFunction(function, spy.copy_buffer, copyBuffer);
    if (which == "vkCmdCopyImage")
        return replaceFunction(function, spy.copy_image, copyImage);
    if (which == "vkCmdUpdateBuffer")
        return replaceFunction(function, spy.update_buffer, updateBuffer);
    if (which == "vkCmdFillBuffer")
        return replaceFunction(function, spy.fill_buffer, fillBuffer);
    return function;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char* name)
{
    const PFN_vkVoidFunction function = spy.get_instance_proc_addr(instance, name);
    const std::string_view which = name;
    if (which == "vkGetDeviceProcAddr")
        return replaceFunction(function, spy.get_device_proc_addr, getDeviceProcAddr);
    if (which == "vkCmdBeginDebugUtilsLabelEXT")
        return replaceFunction(function, spy.begin_label, beginLabel);
    if (which == "vkCmdEndDebugUtilsLabelEXT")
        return replaceFunction(function, spy.end_label, endLabel);
    return function;
}

} // namespace

gpu::DeviceDescription spyOnStages(const gpu::DeviceDescription& description)
{
    spy = {};
    spy.get_instance_proc_addr = description.get_instance_proc_addr;
    gpu::DeviceDescription watched = description;
    watched.get_instance_proc_addr = getInstanceProcAddr;
    watched.debug_labels = true;
    return watched;
}

void forgetCommands()
{
    spy.commands.clear();
    spy.marked.clear();
    spy.done = spy.waiting = 0;
}

void markFragments(const std::string& label)
{
    spy.marked = label;
}

void addBarrier(VkPipelineStageFlags from, VkPipelineStageFlags to)
{
    spy.barrier(from, to);
}

void addCommand(VkPipelineStageFlags stages)
{
    spy.command(stages);
}

const std::vector<SpiedCommand>& spiedCommands()
{
    return spy.commands;
}

} // namespace hearth::test
