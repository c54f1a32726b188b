// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/device.h"

#include <new>
#include <string>

namespace hearth::gpu
{

namespace
{

bool hasFeatures(const DeviceTable& vk, VkPhysicalDevice physical_device, VkFormat format,
                 VkFormatFeatureFlags features)
{
    VkFormatProperties properties;
    vk.vkGetPhysicalDeviceFormatProperties(physical_device, format, &properties);
    return (properties.optimalTilingFeatures & features) == features;
}

} // namespace

Result<Device> makeDevice(const DeviceDescription& description, std::span<const RequiredFormat> more_formats)
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
    HEARTH_TRY(checkLimits(properties));
    for (const std::span<const RequiredFormat> formats : {requiredFormats(), more_formats})
        for (const RequiredFormat& required : formats)
            HEARTH_TRY(checkFormat(device.vk, description.physical_device, properties, required));
    device.vk.vkGetPhysicalDeviceMemoryProperties(description.physical_device, &device.memory);
    device.identity = {properties.vendorID, properties.deviceName};
    device.limits = properties.limits;
    device.handle = description.device;
    device.allocator = description.allocator;
    device.pipeline_cache = description.pipeline_cache;
    device.memory_hooks = description.memory_hooks;
    device.message_hook = description.message_hook;
    device.specializes_shaders = description.specializes_shaders;
    device.sampler_anisotropy = description.sampler_anisotropy;
    const auto has = [&](VkFormat format, VkFormatFeatureFlags features)
    { return hasFeatures(device.vk, description.physical_device, format, features); };
    for (uint32_t format = 0; format < formats::kTexelFormatEnd; ++format)
        if (formats::isPackFormat(format))
        {
            const formats::TexelFormatTraits& traits = *formats::findTexelFormat(format);
            device.texel_formats[format] =
                (traits.family != formats::TexelFamily::astc_hdr || description.astc_hdr) &&
                has(static_cast<VkFormat>(traits.vulkan_format),
                    VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT | VK_FORMAT_FEATURE_TRANSFER_DST_BIT);
        }
    device.filters_d16 = has(VK_FORMAT_D16_UNORM, VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT);
    device.filters_d32 = has(VK_FORMAT_D32_SFLOAT, VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT);
    device.draws_packed_floats =
        has(VK_FORMAT_B10G11R11_UFLOAT_PACK32, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT |
                                                   VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT |
                                                   VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT);
    return device;
}

void warn(const Device& device, const std::string& name, const std::string& where,
          std::string_view what) noexcept
try
{
    if (device.message_hook.warn != nullptr)
        device.message_hook.warn(device.message_hook.user,
                                 formatMessage({Issue::degraded, name, where, std::string(what)}).c_str());
}
catch (const std::bad_alloc&)
{
}

Error vulkanError(VkResult result, const char* what)
{
    Issue issue = Issue::device_failed;
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY)
        issue = Issue::out_of_memory;
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY)
        issue = Issue::device_memory;
    if (result == VK_ERROR_DEVICE_LOST)
        issue = Issue::device_lost;
    return {issue, "", "",
            std::string("cannot ") + what + " (VkResult " + std::to_string(static_cast<int>(result)) + ")"};
}

} // namespace hearth::gpu
