// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/precision/shader_rewriter.h"

#include "tests/runtime/gpu/replace_function.h"

#include <string_view>

namespace hearth::test
{

namespace
{

/// Real functions, and how modules change.
struct Rewriter
{
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    PFN_vkGetDeviceProcAddr get_device_proc_addr = nullptr;
    PFN_vkCreateShaderModule create_shader_module = nullptr;
    RewriteShader rewrite;
};
Rewriter rewriter;

VKAPI_ATTR VkResult VKAPI_CALL createRewrittenModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                                     const VkAllocationCallbacks* allocator,
                                                     VkShaderModule* module)
{
    const std::vector<uint32_t> words = rewriter.rewrite({info->pCode, info->codeSize / sizeof(uint32_t)});
    VkShaderModuleCreateInfo changed = *info;
    changed.pCode = words.data();
    changed.codeSize = words.size() * sizeof(uint32_t);
    return rewriter.create_shader_module(device, &changed, allocator, module);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL findDeviceFunction(VkDevice device, const char* name)
{
    const PFN_vkVoidFunction function = rewriter.get_device_proc_addr(device, name);
    if (std::string_view(name) == "vkCreateShaderModule")
        return replaceFunction(function, rewriter.create_shader_module, createRewrittenModule);
    return function;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL findInstanceFunction(VkInstance instance, const char* name)
{
    const PFN_vkVoidFunction function = rewriter.get_instance_proc_addr(instance, name);
    if (std::string_view(name) == "vkGetDeviceProcAddr")
        return replaceFunction(function, rewriter.get_device_proc_addr, findDeviceFunction);
    return function;
}

} // namespace

gpu::DeviceDescription rewriteShaders(const gpu::DeviceDescription& description, RewriteShader rewrite)
{
    rewriter.get_instance_proc_addr = description.get_instance_proc_addr;
    rewriter.rewrite = std::move(rewrite);
    gpu::DeviceDescription rewriting = description;
    rewriting.get_instance_proc_addr = findInstanceFunction;
    return rewriting;
}

} // namespace hearth::test
