// Vulkan layer that shows the limits, features and formats of another device (HEARTH_TEST_LIMITS=PROFILE) and
// refuses what that device would refuse: calls fail, with a message on stderr.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/limits_layer/device_profile.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string_view>
#include <vulkan/vk_layer.h>

namespace hearth::test
{

namespace
{

/// Functions of the next layer, or of the driver.
struct NextInstance
{
    PFN_vkGetInstanceProcAddr get;
    PFN_vkDestroyInstance destroy;
    PFN_vkGetPhysicalDeviceProperties properties;
    PFN_vkGetPhysicalDeviceProperties2 properties2;
    PFN_vkGetPhysicalDeviceFeatures features;
    PFN_vkGetPhysicalDeviceFeatures2 features2;
    PFN_vkGetPhysicalDeviceFormatProperties format;
    PFN_vkGetPhysicalDeviceFormatProperties2 format2;
};

constexpr VkShaderStageFlags kStages[] = {VK_SHADER_STAGE_VERTEX_BIT, VK_SHADER_STAGE_FRAGMENT_BIT,
                                          VK_SHADER_STAGE_COMPUTE_BIT, ~VkShaderStageFlags{0}};
constexpr size_t kAllStages = 3;

/// Descriptors of a layout, by stage and kind.
struct DescriptorCounts
{
    uint32_t storages = 0, uniforms = 0, textures = 0, images = 0, inputs = 0;

    void add(const DescriptorCounts& other)
    {
        storages += other.storages;
        uniforms += other.uniforms;
        textures += other.textures;
        images += other.images;
        inputs += other.inputs;
    }
};
using LayoutCounts = std::array<DescriptorCounts, std::size(kStages)>;

struct NextDevice
{
    PFN_vkGetDeviceProcAddr get;
    PFN_vkDestroyDevice destroy;
    PFN_vkCreateDescriptorSetLayout set_layout;
    PFN_vkCreatePipelineLayout pipeline_layout;
    PFN_vkCreateShaderModule shader_module;
    PFN_vkCreateImage image;
    VkPhysicalDeviceLimits limits;
    std::map<VkDescriptorSetLayout, LayoutCounts> layouts;
};

std::mutex mutex;
std::map<void*, NextInstance> instances; ///< by dispatch table, as the next
std::map<void*, NextDevice> devices;

const DeviceProfile& profile()
{
    static const DeviceProfile read = []
    {
        const char* path = std::getenv("HEARTH_TEST_LIMITS");
        return readProfile(path == nullptr ? "HEARTH_TEST_LIMITS" : path);
    }();
    return read;
}

/// Return the dispatch table, which all objects of an instance or device share.
void* key(void* handle)
{
    return *static_cast<void**>(handle);
}

NextInstance& findInstance(void* handle)
{
    const std::lock_guard lock(mutex);
    return instances.at(key(handle));
}

NextDevice& findDevice(void* handle)
{
    const std::lock_guard lock(mutex);
    return devices.at(key(handle));
}

VkResult refuse(const std::string& what)
{
    std::fprintf(stderr, "VK_LAYER_HEARTH_limits: %s\n", what.c_str());
    return VK_ERROR_VALIDATION_FAILED_EXT;
}

/// Return false, with a message, if a number is above a limit.
bool isWithin(uint64_t used, uint64_t limit, const char* name)
{
    if (used <= limit)
        return true;
    refuse(std::to_string(used) + " are more than " + name + ", " + std::to_string(limit));
    return false;
}

DescriptorCounts count(std::span<const VkDescriptorSetLayoutBinding> bindings, VkShaderStageFlags stages)
{
    DescriptorCounts counts;
    for (const VkDescriptorSetLayoutBinding& binding : bindings)
    {
        if ((binding.stageFlags & stages) == 0)
            continue;
        switch (binding.descriptorType)
        {
        case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
        case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC:
            counts.storages += binding.descriptorCount;
            break;
        case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
        case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC:
            counts.uniforms += binding.descriptorCount;
            break;
        case VK_DESCRIPTOR_TYPE_STORAGE_IMAGE:
            counts.images += binding.descriptorCount;
            break;
        case VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT:
            counts.inputs += binding.descriptorCount;
            break;
        default:
            counts.textures += binding.descriptorCount;
            break;
        }
    }
    return counts;
}

bool fitsStage(const DescriptorCounts& used, bool is_fragment, const VkPhysicalDeviceLimits& limits)
{
    const uint32_t colors = is_fragment ? 1 : 0;
    return isWithin(used.storages, limits.maxPerStageDescriptorStorageBuffers,
                    "maxPerStageDescriptorStorageBuffers") &&
           isWithin(used.uniforms, limits.maxPerStageDescriptorUniformBuffers,
                    "maxPerStageDescriptorUniformBuffers") &&
           isWithin(used.textures, limits.maxPerStageDescriptorSamplers, "maxPerStageDescriptorSamplers") &&
           isWithin(used.textures, limits.maxPerStageDescriptorSampledImages,
                    "maxPerStageDescriptorSampledImages") &&
           isWithin(used.images, limits.maxPerStageDescriptorStorageImages,
                    "maxPerStageDescriptorStorageImages") &&
           isWithin(used.inputs, limits.maxPerStageDescriptorInputAttachments,
                    "maxPerStageDescriptorInputAttachments") &&
           isWithin(used.storages + used.uniforms + used.textures + used.images + used.inputs + colors,
                    limits.maxPerStageResources, "maxPerStageResources");
}

bool fitsPipeline(const DescriptorCounts& used, const VkPhysicalDeviceLimits& limits)
{
    return isWithin(used.storages, limits.maxDescriptorSetStorageBuffers, "maxDescriptorSetStorageBuffers") &&
           isWithin(used.uniforms, limits.maxDescriptorSetUniformBuffers, "maxDescriptorSetUniformBuffers") &&
           isWithin(used.textures, limits.maxDescriptorSetSamplers, "maxDescriptorSetSamplers") &&
           isWithin(used.textures, limits.maxDescriptorSetSampledImages, "maxDescriptorSetSampledImages") &&
           isWithin(used.images, limits.maxDescriptorSetStorageImages, "maxDescriptorSetStorageImages") &&
           isWithin(used.inputs, limits.maxDescriptorSetInputAttachments, "maxDescriptorSetInputAttachments");
}

/// Return true if the workgroups of a module fit; modules of other stages have none.
bool fitsWorkgroup(std::span<const uint32_t> words, const VkPhysicalDeviceLimits& limits)
{
    constexpr uint32_t kOpExecutionMode = 16, kLocalSize = 17;
    constexpr size_t kHeaderWords = 5;
    for (size_t i = kHeaderWords; i < words.size(); i += words[i] >> 16)
        if ((words[i] & 0xFFFFu) == kOpExecutionMode && words[i + 2] == kLocalSize)
        {
            const std::span<const uint32_t> size = words.subspan(i + 3, 3);
            for (size_t axis = 0; axis < 3; ++axis)
                if (!isWithin(size[axis], limits.maxComputeWorkGroupSize[axis], "maxComputeWorkGroupSize"))
                    return false;
            return isWithin(uint64_t{size[0]} * size[1] * size[2], limits.maxComputeWorkGroupInvocations,
                            "maxComputeWorkGroupInvocations");
        }
    return true;
}

VKAPI_ATTR void VKAPI_CALL getProperties(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties)
{
    findInstance(device).properties(device, properties);
    clampLimits(profile(), properties->limits);
}

VKAPI_ATTR void VKAPI_CALL getProperties2(VkPhysicalDevice device, VkPhysicalDeviceProperties2* properties)
{
    findInstance(device).properties2(device, properties);
    clampLimits(profile(), properties->properties.limits);
}

VKAPI_ATTR void VKAPI_CALL getFeatures(VkPhysicalDevice device, VkPhysicalDeviceFeatures* features)
{
    findInstance(device).features(device, features);
    clampFeatures(profile(), *features);
}

VKAPI_ATTR void VKAPI_CALL getFeatures2(VkPhysicalDevice device, VkPhysicalDeviceFeatures2* features)
{
    findInstance(device).features2(device, features);
    clampFeatures(profile(), features->features);
}

VKAPI_ATTR void VKAPI_CALL getFormat(VkPhysicalDevice device, VkFormat format, VkFormatProperties* properties)
{
    findInstance(device).format(device, format, properties);
    clampFormat(profile(), format, *properties);
}

VKAPI_ATTR void VKAPI_CALL getFormat2(VkPhysicalDevice device, VkFormat format,
                                      VkFormatProperties2* properties)
{
    findInstance(device).format2(device, format, properties);
    clampFormat(profile(), format, properties->formatProperties);
}

VKAPI_ATTR VkResult VKAPI_CALL createSetLayout(VkDevice device, const VkDescriptorSetLayoutCreateInfo* info,
                                               const VkAllocationCallbacks* allocator,
                                               VkDescriptorSetLayout* layout)
{
    NextDevice& next = findDevice(device);
    const VkResult result = next.set_layout(device, info, allocator, layout);
    if (result != VK_SUCCESS)
        return result;
    LayoutCounts counts{};
    for (size_t i = 0; i < std::size(kStages); ++i)
        counts[i] = count({info->pBindings, info->bindingCount}, kStages[i]);
    const std::lock_guard lock(mutex);
    next.layouts[*layout] = counts;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL createPipelineLayout(VkDevice device, const VkPipelineLayoutCreateInfo* info,
                                                    const VkAllocationCallbacks* allocator,
                                                    VkPipelineLayout* layout)
{
    NextDevice& next = findDevice(device);
    LayoutCounts sum{};
    {
        const std::lock_guard lock(mutex);
        for (const VkDescriptorSetLayout set : std::span(info->pSetLayouts, info->setLayoutCount))
            for (size_t i = 0; i < sum.size(); ++i)
                sum[i].add(next.layouts.at(set)[i]);
    }
    bool fits = isWithin(info->setLayoutCount, next.limits.maxBoundDescriptorSets, "maxBoundDescriptorSets");
    for (const VkPushConstantRange& range :
         std::span(info->pPushConstantRanges, info->pushConstantRangeCount))
        fits = fits &&
               isWithin(range.offset + range.size, next.limits.maxPushConstantsSize, "maxPushConstantsSize");
    for (size_t i = 0; i < kAllStages; ++i)
        fits = fits && fitsStage(sum[i], kStages[i] == VK_SHADER_STAGE_FRAGMENT_BIT, next.limits);
    if (!fits || !fitsPipeline(sum[kAllStages], next.limits))
        return refuse("a pipeline layout is refused");
    return next.pipeline_layout(device, info, allocator, layout);
}

VKAPI_ATTR VkResult VKAPI_CALL createShaderModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                                  const VkAllocationCallbacks* allocator,
                                                  VkShaderModule* module)
{
    NextDevice& next = findDevice(device);
    if (!fitsWorkgroup({info->pCode, info->codeSize / sizeof(uint32_t)}, next.limits))
        return refuse("a shader is refused");
    return next.shader_module(device, info, allocator, module);
}

VKAPI_ATTR VkResult VKAPI_CALL createImage(VkDevice device, const VkImageCreateInfo* info,
                                           const VkAllocationCallbacks* allocator, VkImage* image)
{
    NextDevice& next = findDevice(device);
    const bool fits = isWithin(info->extent.width, next.limits.maxImageDimension2D, "maxImageDimension2D") &&
                      isWithin(info->extent.height, next.limits.maxImageDimension2D, "maxImageDimension2D") &&
                      isWithin(info->arrayLayers, next.limits.maxImageArrayLayers, "maxImageArrayLayers");
    if (!fits || profile().missing_formats.contains(info->format))
        return refuse("an image is refused");
    return next.image(device, info, allocator, image);
}

/// Return the loader's link to the next layer, and move the chain on.
template <typename LayerInfo>
auto* takeLink(const void* chain, VkStructureType type)
{
    auto* info = static_cast<LayerInfo*>(const_cast<void*>(chain));
    while (info != nullptr && !(info->sType == type && info->function == VK_LAYER_LINK_INFO))
        info = static_cast<LayerInfo*>(const_cast<void*>(info->pNext));
    auto* link = info->u.pLayerInfo;
    info->u.pLayerInfo = link->pNext;
    return link;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkInstance* instance)
{
    const auto* link =
        takeLink<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    const PFN_vkGetInstanceProcAddr get = link->pfnNextGetInstanceProcAddr;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(get(nullptr, "vkCreateInstance"));
    const VkResult result = create(info, allocator, instance);
    if (result != VK_SUCCESS)
        return result;
    NextInstance next{};
    next.get = get;
    const auto load = [&]<typename T>(T& function, const char* name)
    { function = reinterpret_cast<T>(get(*instance, name)); };
    load(next.destroy, "vkDestroyInstance");
    load(next.properties, "vkGetPhysicalDeviceProperties");
    load(next.properties2, "vkGetPhysicalDeviceProperties2");
    load(next.features, "vkGetPhysicalDeviceFeatures");
    load(next.features2, "vkGetPhysicalDeviceFeatures2");
    load(next.format, "vkGetPhysicalDeviceFormatProperties");
    load(next.format2, "vkGetPhysicalDeviceFormatProperties2");
    const std::lock_guard lock(mutex);
    instances[key(*instance)] = next;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroyInstance(VkInstance instance, const VkAllocationCallbacks* allocator)
{
    if (instance == VK_NULL_HANDLE)
        return;
    const PFN_vkDestroyInstance destroy = findInstance(instance).destroy;
    {
        const std::lock_guard lock(mutex);
        instances.erase(key(instance));
    }
    destroy(instance, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical_device, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkDevice* device)
{
    if (info->pEnabledFeatures != nullptr)
        if (const std::string missing = findMissingFeature(profile(), *info->pEnabledFeatures);
            !missing.empty())
        {
            refuse("a device without " + missing);
            return VK_ERROR_FEATURE_NOT_PRESENT;
        }
    const auto* link =
        takeLink<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    const PFN_vkGetInstanceProcAddr get_instance = link->pfnNextGetInstanceProcAddr;
    const PFN_vkGetDeviceProcAddr get = link->pfnNextGetDeviceProcAddr;
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(get_instance(nullptr, "vkCreateDevice"));
    const VkResult result = create(physical_device, info, allocator, device);
    if (result != VK_SUCCESS)
        return result;
    NextDevice next{};
    next.get = get;
    const auto load = [&]<typename T>(T& function, const char* name)
    { function = reinterpret_cast<T>(get(*device, name)); };
    load(next.destroy, "vkDestroyDevice");
    load(next.set_layout, "vkCreateDescriptorSetLayout");
    load(next.pipeline_layout, "vkCreatePipelineLayout");
    load(next.shader_module, "vkCreateShaderModule");
    load(next.image, "vkCreateImage");
    VkPhysicalDeviceProperties properties;
    getProperties(physical_device, &properties);
    next.limits = properties.limits;
    const std::lock_guard lock(mutex);
    devices[key(*device)] = std::move(next);
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroyDevice(VkDevice device, const VkAllocationCallbacks* allocator)
{
    if (device == VK_NULL_HANDLE)
        return;
    const PFN_vkDestroyDevice destroy = findDevice(device).destroy;
    {
        const std::lock_guard lock(mutex);
        devices.erase(key(device));
    }
    destroy(device, allocator);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char* name);
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name);

/// Return the layer's own function of a name, or null.
PFN_vkVoidFunction findOwn(std::string_view name)
{
#define HEARTH_ENTRY(name, function)                                                                         \
    {                                                                                                        \
        #name, reinterpret_cast<PFN_vkVoidFunction>(function)                                                \
    }
    static const std::map<std::string_view, PFN_vkVoidFunction> kFunctions = {
        HEARTH_ENTRY(vkCreateDescriptorSetLayout, createSetLayout),
        HEARTH_ENTRY(vkCreateDevice, createDevice),
        HEARTH_ENTRY(vkCreateImage, createImage),
        HEARTH_ENTRY(vkCreateInstance, createInstance),
        HEARTH_ENTRY(vkCreatePipelineLayout, createPipelineLayout),
        HEARTH_ENTRY(vkCreateShaderModule, createShaderModule),
        HEARTH_ENTRY(vkDestroyDevice, destroyDevice),
        HEARTH_ENTRY(vkDestroyInstance, destroyInstance),
        HEARTH_ENTRY(vkGetDeviceProcAddr, getDeviceProcAddr),
        HEARTH_ENTRY(vkGetInstanceProcAddr, getInstanceProcAddr),
        HEARTH_ENTRY(vkGetPhysicalDeviceFeatures, getFeatures),
        HEARTH_ENTRY(vkGetPhysicalDeviceFeatures2, getFeatures2),
        HEARTH_ENTRY(vkGetPhysicalDeviceFormatProperties, getFormat),
        HEARTH_ENTRY(vkGetPhysicalDeviceFormatProperties2, getFormat2),
        HEARTH_ENTRY(vkGetPhysicalDeviceProperties, getProperties),
        HEARTH_ENTRY(vkGetPhysicalDeviceProperties2, getProperties2),
    };
#undef HEARTH_ENTRY
    const auto found = kFunctions.find(name);
    return found == kFunctions.end() ? nullptr : found->second;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char* name)
{
    if (const PFN_vkVoidFunction own = findOwn(name))
        return own;
    return instance == VK_NULL_HANDLE ? nullptr : findInstance(instance).get(instance, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name)
{
    const NextDevice& next = findDevice(device);
    const PFN_vkVoidFunction function = next.get(device, name);
    const PFN_vkVoidFunction own = function == nullptr ? nullptr : findOwn(name);
    return own == nullptr ? function : own;
}

} // namespace

} // namespace hearth::test

extern "C" __attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* negotiated)
{
    constexpr uint32_t kVersion = 2;
    if (negotiated->loaderLayerInterfaceVersion < kVersion)
        return VK_ERROR_INITIALIZATION_FAILED;
    negotiated->loaderLayerInterfaceVersion = kVersion;
    negotiated->pfnGetInstanceProcAddr = hearth::test::getInstanceProcAddr;
    negotiated->pfnGetDeviceProcAddr = hearth::test::getDeviceProcAddr;
    negotiated->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
