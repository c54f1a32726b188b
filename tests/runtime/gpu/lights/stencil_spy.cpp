// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/lights/stencil_spy.h"

#include "formats/base/assert.h"
#include "tests/runtime/gpu/replace_function.h"

#include <map>
#include <string_view>
#include <type_traits>
#include <utility>

namespace hearth::test
{

namespace
{

enum class Kind
{
    marks, ///< the pixels of a volume
    takes, ///< the marks away
};

/// Render pass and subpass.
using Place = std::pair<VkRenderPass, uint32_t>;

struct Spy
{
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    PFN_vkGetDeviceProcAddr get_device_proc_addr = nullptr;
    PFN_vkCreateGraphicsPipelines create_pipelines = nullptr;
    PFN_vkDestroyPipeline destroy_pipeline = nullptr;
    PFN_vkCmdBindPipeline bind_pipeline = nullptr;
    PFN_vkCmdDraw draw = nullptr;
    PFN_vkCreateQueryPool create_query_pool = nullptr;
    PFN_vkDestroyQueryPool destroy_query_pool = nullptr;
    PFN_vkCmdResetQueryPool reset_query_pool = nullptr;
    PFN_vkCmdBeginQuery begin_query = nullptr;
    PFN_vkCmdEndQuery end_query = nullptr;
    PFN_vkGetQueryPoolResults get_results = nullptr;

    std::map<Place, VkPipeline> counting;
    std::map<VkPipeline, std::pair<Kind, Place>> watched;
    VkPipeline bound = VK_NULL_HANDLE;
    VkQueryPool queries = VK_NULL_HANDLE;
    uint32_t query_count = 0, next_query = 0;

    /// Create a pipeline that draws over the whole frame where the stencil is not 0, and changes nothing.
    /// whole_frame  a pipeline of that place without fragments, whose vertices cover the frame
    void addCounting(VkDevice device, const VkGraphicsPipelineCreateInfo& whole_frame)
    {
        const Place place{whole_frame.renderPass, whole_frame.subpass};
        if (counting.contains(place))
            return;
        VkPipelineDepthStencilStateCreateInfo depth = *whole_frame.pDepthStencilState;
        depth.front.compareOp = VK_COMPARE_OP_NOT_EQUAL;
        depth.front.reference = 0;
        depth.front.compareMask = 0xFF;
        depth.front.writeMask = 0;
        depth.front.passOp = depth.front.failOp = depth.front.depthFailOp = VK_STENCIL_OP_KEEP;
        depth.back = depth.front;
        VkGraphicsPipelineCreateInfo info = whole_frame;
        info.pDepthStencilState = &depth;
        VkPipeline pipeline = VK_NULL_HANDLE;
        HEARTH_ASSERT(create_pipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline) == VK_SUCCESS);
        counting[place] = pipeline;
    }
};

Spy spy;

VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                               const VkGraphicsPipelineCreateInfo* infos,
                                               const VkAllocationCallbacks* allocator, VkPipeline* pipelines)
{
    const VkResult result = spy.create_pipelines(device, cache, count, infos, allocator, pipelines);
    for (uint32_t i = 0; i < count && result == VK_SUCCESS; ++i)
    {
        const VkPipelineDepthStencilStateCreateInfo* const depth = infos[i].pDepthStencilState;
        if (depth == nullptr || depth->stencilTestEnable == VK_FALSE)
            continue;
        const Place place{infos[i].renderPass, infos[i].subpass};
        const VkStencilOpState& front = depth->front;
        if (front.compareOp == VK_COMPARE_OP_ALWAYS && front.passOp == VK_STENCIL_OP_ZERO)
            spy.addCounting(device, infos[i]);
        else if (front.depthFailOp == VK_STENCIL_OP_DECREMENT_AND_WRAP)
            spy.watched[pipelines[i]] = {Kind::marks, place};
        else if (front.compareOp == VK_COMPARE_OP_NOT_EQUAL)
            spy.watched[pipelines[i]] = {Kind::takes, place};
    }
    return result;
}

VKAPI_ATTR void VKAPI_CALL bindPipeline(VkCommandBuffer commands, VkPipelineBindPoint point,
                                        VkPipeline pipeline)
{
    spy.bound = pipeline;
    spy.bind_pipeline(commands, point, pipeline);
}

/// Draw, and count the marks. The caller binds a pipeline before its next draw.
VKAPI_ATTR void VKAPI_CALL draw(VkCommandBuffer commands, uint32_t vertices, uint32_t instances,
                                uint32_t first_vertex, uint32_t first_instance)
{
    spy.draw(commands, vertices, instances, first_vertex, first_instance);
    const auto found = spy.watched.find(spy.bound);
    if (found == spy.watched.end())
        return;
    const auto& [kind, place] = found->second;
    HEARTH_ASSERT(spy.next_query < spy.query_count);
    HEARTH_ASSERT((spy.next_query % 2 == 0) == (kind == Kind::marks));
    spy.bind_pipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, spy.counting.at(place));
    spy.begin_query(commands, spy.queries, spy.next_query, 0);
    spy.draw(commands, 3, 1, 0, 0);
    spy.end_query(commands, spy.queries, spy.next_query++);
    spy.bound = VK_NULL_HANDLE;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name)
{
    const PFN_vkVoidFunction function = spy.get_device_proc_addr(device, name);
    const std::string_view which = name;
    if (which == "vkCreateGraphicsPipelines")
        return replaceFunction(function, spy.create_pipelines, createPipelines);
    if (which == "vkCmdBindPipeline")
        return replaceFunction(function, spy.bind_pipeline, bindPipeline);
    if (which == "vkCmdDraw")
        return replaceFunction(function, spy.draw, draw);
    return function;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char* name)
{
    const PFN_vkVoidFunction function = spy.get_instance_proc_addr(instance, name);
    if (std::string_view(name) == "vkGetDeviceProcAddr")
        return replaceFunction(function, spy.get_device_proc_addr, getDeviceProcAddr);
    return function;
}

} // namespace

gpu::DeviceDescription spyOnStencil(const gpu::DeviceDescription& description)
{
    spy = {};
    spy.get_instance_proc_addr = description.get_instance_proc_addr;
    gpu::DeviceDescription watched = description;
    watched.get_instance_proc_addr = getInstanceProcAddr;
    return watched;
}

void beginStencilCounts(const gpu::Device& device, uint32_t lights)
{
    const auto load = [&](auto& function, const char* name)
    {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(
            spy.get_device_proc_addr(device.handle, name));
        HEARTH_ASSERT(function != nullptr);
    };
    load(spy.destroy_pipeline, "vkDestroyPipeline");
    load(spy.create_query_pool, "vkCreateQueryPool");
    load(spy.destroy_query_pool, "vkDestroyQueryPool");
    load(spy.reset_query_pool, "vkCmdResetQueryPool");
    load(spy.begin_query, "vkCmdBeginQuery");
    load(spy.end_query, "vkCmdEndQuery");
    load(spy.get_results, "vkGetQueryPoolResults");
    spy.query_count = 2 * lights;
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_OCCLUSION;
    info.queryCount = spy.query_count;
    HEARTH_ASSERT(spy.create_query_pool(device.handle, &info, nullptr, &spy.queries) == VK_SUCCESS);
}

void endStencilCounts(const gpu::Device& device)
{
    for (const auto& [place, pipeline] : spy.counting)
        spy.destroy_pipeline(device.handle, pipeline, nullptr);
    spy.counting.clear();
    spy.destroy_query_pool(device.handle, spy.queries, nullptr);
}

void resetStencilCounts(const gpu::Device&, VkCommandBuffer commands)
{
    spy.reset_query_pool(commands, spy.queries, 0, spy.query_count);
    spy.next_query = 0;
}

std::vector<StencilMarks> readStencilCounts(const gpu::Device& device)
{
    std::vector<uint32_t> samples(spy.next_query);
    if (!samples.empty())
        HEARTH_ASSERT(spy.get_results(device.handle, spy.queries, 0, spy.next_query,
                                      samples.size() * sizeof(uint32_t), samples.data(), sizeof(uint32_t),
                                      VK_QUERY_RESULT_WAIT_BIT) == VK_SUCCESS);
    std::vector<StencilMarks> marks;
    for (size_t i = 0; i + 1 < samples.size(); i += 2)
        marks.push_back({samples[i] > 0, samples[i + 1] > 0});
    return marks;
}

} // namespace hearth::test
