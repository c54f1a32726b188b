// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/shadows/depth_filtering.h"

#include "tests/runtime/gpu/replace_function.h"

#include <string_view>

namespace hearth::test
{

namespace
{

PFN_vkGetInstanceProcAddr real_get_instance_proc_addr;
PFN_vkGetPhysicalDeviceFormatProperties real_format_properties;
bool filters_depths;

VKAPI_ATTR void VKAPI_CALL getChangedProperties(VkPhysicalDevice device, VkFormat format,
                                                VkFormatProperties* properties)
{
    constexpr VkFormatFeatureFlags kFiltered = VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    real_format_properties(device, format, properties);
    VkFormatFeatureFlags& features = properties->optimalTilingFeatures;
    if ((features & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0)
        features = filters_depths ? features | kFiltered : features & ~kFiltered;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL findChangedFunction(VkInstance instance, const char* name)
{
    const PFN_vkVoidFunction function = real_get_instance_proc_addr(instance, name);
    if (std::string_view(name) == "vkGetPhysicalDeviceFormatProperties")
        return replaceFunction(function, real_format_properties, getChangedProperties);
    return function;
}

} // namespace

gpu::DeviceDescription sayDepthFiltering(const gpu::DeviceDescription& description, bool filters)
{
    real_get_instance_proc_addr = description.get_instance_proc_addr;
    filters_depths = filters;
    gpu::DeviceDescription changed = description;
    changed.get_instance_proc_addr = findChangedFunction;
    return changed;
}

} // namespace hearth::test
