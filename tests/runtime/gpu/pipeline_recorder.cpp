// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/pipeline_recorder.h"

#include "tests/runtime/gpu/replace_function.h"

#include <span>
#include <string_view>

namespace hearth::test
{

namespace
{

struct RecordedLayout
{
    std::vector<RecordedSet> sets;
    std::vector<VkPushConstantRange> push;
};

/// Real functions, and the objects by their latest handles.
struct Recorder
{
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    PFN_vkGetDeviceProcAddr get_device_proc_addr = nullptr;
    PFN_vkCreateShaderModule create_shader_module = nullptr;
    PFN_vkCreateDescriptorSetLayout create_set_layout = nullptr;
    PFN_vkCreatePipelineLayout create_pipeline_layout = nullptr;

    std::map<VkShaderModule, std::vector<uint32_t>> modules;
    std::map<VkDescriptorSetLayout, RecordedSet> sets;
    std::map<VkPipelineLayout, RecordedLayout> layouts;
    std::vector<RecordedPipeline> pipelines;

    /// Return a handle that is no pipeline.
    VkPipeline add(VkPipelineLayout layout, std::span<const VkPipelineShaderStageCreateInfo> stages)
    {
        RecordedPipeline pipeline{{}, layouts.at(layout).sets, layouts.at(layout).push};
        for (const VkPipelineShaderStageCreateInfo& info : stages)
        {
            RecordedStage stage{info.stage, modules.at(info.module), {}};
            if (const VkSpecializationInfo* constants = info.pSpecializationInfo; constants != nullptr)
                for (const VkSpecializationMapEntry& entry :
                     std::span(constants->pMapEntries, constants->mapEntryCount))
                    stage.constants[entry.constantID] = entry.size;
            pipeline.stages.push_back(std::move(stage));
        }
        pipelines.push_back(std::move(pipeline));
        return reinterpret_cast<VkPipeline>(this);
    }
};
Recorder recorder;

VKAPI_ATTR VkResult VKAPI_CALL createShaderModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                                  const VkAllocationCallbacks* allocator,
                                                  VkShaderModule* module)
{
    const VkResult result = recorder.create_shader_module(device, info, allocator, module);
    recorder.modules[*module].assign(info->pCode, info->pCode + info->codeSize / sizeof(uint32_t));
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createSetLayout(VkDevice device, const VkDescriptorSetLayoutCreateInfo* info,
                                               const VkAllocationCallbacks* allocator,
                                               VkDescriptorSetLayout* layout)
{
    const VkResult result = recorder.create_set_layout(device, info, allocator, layout);
    recorder.sets[*layout].assign(info->pBindings, info->pBindings + info->bindingCount);
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createPipelineLayout(VkDevice device, const VkPipelineLayoutCreateInfo* info,
                                                    const VkAllocationCallbacks* allocator,
                                                    VkPipelineLayout* layout)
{
    const VkResult result = recorder.create_pipeline_layout(device, info, allocator, layout);
    RecordedLayout& recorded = recorder.layouts[*layout] = {};
    for (const VkDescriptorSetLayout set : std::span(info->pSetLayouts, info->setLayoutCount))
        recorded.sets.push_back(recorder.sets.at(set));
    recorded.push.assign(info->pPushConstantRanges, info->pPushConstantRanges + info->pushConstantRangeCount);
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createComputePipelines(VkDevice, VkPipelineCache, uint32_t count,
                                                      const VkComputePipelineCreateInfo* infos,
                                                      const VkAllocationCallbacks*, VkPipeline* pipelines)
{
    for (uint32_t i = 0; i < count; ++i)
        pipelines[i] = recorder.add(infos[i].layout, {&infos[i].stage, 1});
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL createGraphicsPipelines(VkDevice, VkPipelineCache, uint32_t count,
                                                       const VkGraphicsPipelineCreateInfo* infos,
                                                       const VkAllocationCallbacks*, VkPipeline* pipelines)
{
    for (uint32_t i = 0; i < count; ++i)
        pipelines[i] = recorder.add(infos[i].layout, {infos[i].pStages, infos[i].stageCount});
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroyPipeline(VkDevice, VkPipeline, const VkAllocationCallbacks*) {}

VKAPI_ATTR void VKAPI_CALL updateDescriptorSets(VkDevice, uint32_t, const VkWriteDescriptorSet*, uint32_t,
                                                const VkCopyDescriptorSet*)
{
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name)
{
    const PFN_vkVoidFunction function = recorder.get_device_proc_addr(device, name);
    const std::string_view which = name;
    if (which == "vkCreateShaderModule")
        return replaceFunction(function, recorder.create_shader_module, createShaderModule);
    if (which == "vkCreateDescriptorSetLayout")
        return replaceFunction(function, recorder.create_set_layout, createSetLayout);
    if (which == "vkCreatePipelineLayout")
        return replaceFunction(function, recorder.create_pipeline_layout, createPipelineLayout);
    if (which == "vkCreateComputePipelines")
        return reinterpret_cast<PFN_vkVoidFunction>(createComputePipelines);
    if (which == "vkCreateGraphicsPipelines")
        return reinterpret_cast<PFN_vkVoidFunction>(createGraphicsPipelines);
    if (which == "vkDestroyPipeline")
        return reinterpret_cast<PFN_vkVoidFunction>(destroyPipeline);
    if (which == "vkUpdateDescriptorSets")
        return reinterpret_cast<PFN_vkVoidFunction>(updateDescriptorSets);
    return function;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char* name)
{
    const PFN_vkVoidFunction function = recorder.get_instance_proc_addr(instance, name);
    if (std::string_view(name) == "vkGetDeviceProcAddr")
        return replaceFunction(function, recorder.get_device_proc_addr, getDeviceProcAddr);
    return function;
}

} // namespace

gpu::DeviceDescription recordPipelines(const gpu::DeviceDescription& description)
{
    recorder = {};
    recorder.get_instance_proc_addr = description.get_instance_proc_addr;
    gpu::DeviceDescription recording = description;
    recording.get_instance_proc_addr = getInstanceProcAddr;
    recording.specializes_shaders = false; // stages are found by the words of listed shaders
    return recording;
}

const std::vector<RecordedPipeline>& recordedPipelines()
{
    return recorder.pipelines;
}

} // namespace hearth::test
