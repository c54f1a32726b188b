// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/device.h"

#include <string>

namespace hearth::gpu
{

namespace
{

struct RequiredFormat
{
    VkFormat format;
    VkFormatFeatureFlags features;
    const char* name;
};

constexpr RequiredFormat kRequiredFormats[] = {
    {VK_FORMAT_R32_UINT, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, "R32_UINT"},
    {VK_FORMAT_R8G8B8A8_SRGB,
     VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT,
     "R8G8B8A8_SRGB"},
    {VK_FORMAT_D32_SFLOAT, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT, "D32_SFLOAT"},
    {VK_FORMAT_D16_UNORM, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT, "D16_UNORM"},
};

/// True if textures of the format can be uploaded and filtered.
bool canSample(const DeviceTable& vk, VkPhysicalDevice physical_device, VkFormat format)
{
    constexpr VkFormatFeatureFlags kFeatures =
        VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT | VK_FORMAT_FEATURE_TRANSFER_DST_BIT;
    VkFormatProperties properties;
    vk.vkGetPhysicalDeviceFormatProperties(physical_device, format, &properties);
    return (properties.optimalTilingFeatures & kFeatures) == kFeatures;
}

} // namespace

Result<Device> makeDevice(const DeviceDescription& description)
{
    Device device;
    const char* missing =
        device.vk.load(description.get_instance_proc_addr, description.instance, description.device);
    if (missing == nullptr && description.debug_labels)
        missing = device.vk.loadDebugLabels(description.get_instance_proc_addr, description.instance);
    if (missing != nullptr)
        return Error{Issue::device, "", "", std::string("the driver has no entry point ") + missing};

    VkPhysicalDeviceProperties properties;
    device.vk.vkGetPhysicalDeviceProperties(description.physical_device, &properties);
    if (properties.apiVersion < VK_API_VERSION_1_1)
        return Error{Issue::device, "", "", std::string(properties.deviceName) + " has no Vulkan 1.1"};
    for (const RequiredFormat& required : kRequiredFormats)
    {
        VkFormatProperties format;
        device.vk.vkGetPhysicalDeviceFormatProperties(description.physical_device, required.format, &format);
        if ((format.optimalTilingFeatures & required.features) != required.features)
            return Error{Issue::device, "", "",
                         std::string(properties.deviceName) + " cannot render to " + required.name};
    }
    device.vk.vkGetPhysicalDeviceMemoryProperties(description.physical_device, &device.memory);
    device.identity = {properties.vendorID, properties.deviceName};
    device.limits = properties.limits;
    device.handle = description.device;
    device.allocator = description.allocator;
    device.pipeline_cache = description.pipeline_cache;
    device.memory_hooks = description.memory_hooks;
    device.message_hook = description.message_hook;
    device.sampler_anisotropy = description.sampler_anisotropy;
    device.samples_unorm16 = canSample(device.vk, description.physical_device, VK_FORMAT_R16G16B16A16_UNORM);
    return device;
}

void warn(const Device& device, const std::string& name, const std::string& where, const std::string& what)
{
    if (device.message_hook.warn != nullptr)
        device.message_hook.warn(device.message_hook.user,
                                 formatMessage({Issue::degraded, name, where, what}).c_str());
}

Error vulkanError(VkResult result, const char* what)
{
    const char* reason = "error";
    switch (result)
    {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        reason = "out of memory";
        break;
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        reason = "out of device memory";
        break;
    case VK_ERROR_DEVICE_LOST:
        reason = "the device was lost";
        break;
    default:
        break;
    }
    return {Issue::device_failed, "", "",
            std::string("cannot ") + what + ": " + reason + " (VkResult " +
                std::to_string(static_cast<int>(result)) + ")"};
}

} // namespace hearth::gpu
