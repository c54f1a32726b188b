// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/vulkan_host.h"

#include "runtime/gpu/vulkan/image_barrier.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <dlfcn.h>

#define HEARTH_HOST_INSTANCE_FUNCTIONS(X)                                                                    \
    X(vkCreateDevice)                                                                                        \
    X(vkDestroyInstance)                                                                                     \
    X(vkEnumerateDeviceExtensionProperties)                                                                  \
    X(vkEnumeratePhysicalDevices)                                                                            \
    X(vkGetDeviceProcAddr)                                                                                   \
    X(vkGetPhysicalDeviceFeatures)                                                                           \
    X(vkGetPhysicalDeviceProperties)                                                                         \
    X(vkGetPhysicalDeviceQueueFamilyProperties)

#define HEARTH_HOST_DEVICE_FUNCTIONS(X)                                                                      \
    X(vkAllocateCommandBuffers)                                                                              \
    X(vkBeginCommandBuffer)                                                                                  \
    X(vkCmdCopyBuffer)                                                                                       \
    X(vkCmdCopyImageToBuffer)                                                                                \
    X(vkCmdPipelineBarrier)                                                                                  \
    X(vkCreateCommandPool)                                                                                   \
    X(vkCreateFence)                                                                                         \
    X(vkCreateQueryPool)                                                                                     \
    X(vkDestroyCommandPool)                                                                                  \
    X(vkDestroyDevice)                                                                                       \
    X(vkDestroyFence)                                                                                        \
    X(vkDestroyQueryPool)                                                                                    \
    X(vkDeviceWaitIdle)                                                                                      \
    X(vkEndCommandBuffer)                                                                                    \
    X(vkFreeCommandBuffers)                                                                                  \
    X(vkGetDeviceQueue)                                                                                      \
    X(vkGetQueryPoolResults)                                                                                 \
    X(vkQueueSubmit)                                                                                         \
    X(vkWaitForFences)

namespace hearth::viewer
{

using gpu::vulkanError;

struct HostTable
{
#define HEARTH_MEMBER(name) PFN_##name name = nullptr;
    HEARTH_HOST_INSTANCE_FUNCTIONS(HEARTH_MEMBER)
    HEARTH_HOST_DEVICE_FUNCTIONS(HEARTH_MEMBER)
#undef HEARTH_MEMBER
    PFN_vkDestroyDebugUtilsMessengerEXT vkDestroyDebugUtilsMessengerEXT = nullptr; // with validation only
    PFN_vkDestroySurfaceKHR vkDestroySurfaceKHR = nullptr;                         // with a window only
    PFN_vkGetPhysicalDeviceSurfaceSupportKHR vkGetPhysicalDeviceSurfaceSupportKHR = nullptr;
};

namespace
{

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

Error deviceError(std::string detail)
{
    return {Issue::device, "", "", std::move(detail)};
}

VKAPI_ATTR VkBool32 VKAPI_CALL collectMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                              VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data,
                                              void* messages)
{
    static_cast<std::vector<std::string>*>(messages)->emplace_back(data->pMessage);
    return VK_FALSE;
}

std::string lowerCase(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Rank of a device type: higher is likely to be faster.
int deviceTypeRank(VkPhysicalDeviceType type)
{
    switch (type)
    {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return 1;
    default:
        return 0;
    }
}

/// Find a queue family that draws and computes, and presents to the surface if there is one.
bool findQueueFamily(const HostTable& vk, VkPhysicalDevice device, VkSurfaceKHR surface, uint32_t& family)
{
    uint32_t count = 0;
    vk.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (family = 0; family < count; ++family)
    {
        VkBool32 presents = VK_TRUE;
        if (surface != VK_NULL_HANDLE)
            vk.vkGetPhysicalDeviceSurfaceSupportKHR(device, family, surface, &presents);
        if ((families[family].queueFlags & kNeeded) == kNeeded && presents == VK_TRUE)
            return true;
    }
    return false;
}

bool hasExtension(const HostTable& vk, VkPhysicalDevice device, const char* name)
{
    uint32_t count = 0;
    vk.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vk.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const VkExtensionProperties& extension)
                       { return std::strcmp(extension.extensionName, name) == 0; });
}

} // namespace

VulkanHost::VulkanHost() : vk_(std::make_unique<HostTable>()) {}

VulkanHost::~VulkanHost()
{
    if (device_ != VK_NULL_HANDLE)
    {
        vk_->vkDeviceWaitIdle(device_);
        for (const VkQueryPool pool : query_pools_)
            vk_->vkDestroyQueryPool(device_, pool, nullptr);
        if (command_pool_ != VK_NULL_HANDLE)
            vk_->vkDestroyCommandPool(device_, command_pool_, nullptr);
        vk_->vkDestroyDevice(device_, nullptr);
    }
    if (surface_ != VK_NULL_HANDLE)
        vk_->vkDestroySurfaceKHR(instance_, surface_, nullptr);
    if (messenger_ != VK_NULL_HANDLE)
        vk_->vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    if (instance_ != VK_NULL_HANDLE)
        vk_->vkDestroyInstance(instance_, nullptr);
    if (library_ != nullptr)
        ::dlclose(library_);
}

Result<std::unique_ptr<VulkanHost>> VulkanHost::create(const HostOptions& options)
{
    std::unique_ptr<VulkanHost> host(new VulkanHost);
    HEARTH_TRY(host->openLoader());
    HEARTH_TRY(host->createInstance(options));
    if (options.window != nullptr)
    {
        HEARTH_ASSIGN_OR_RETURN(host->surface_, options.window->create_surface(host->instance_));
    }
    HEARTH_TRY(host->chooseDevice(options.device_name));
    HEARTH_TRY(host->createDevice());
    return host;
}

Status VulkanHost::openLoader()
{
    library_ = ::dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr)
        return deviceError("there is no Vulkan loader (libvulkan.so.1)");
    get_instance_proc_addr_ =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(::dlsym(library_, "vkGetInstanceProcAddr"));
    if (get_instance_proc_addr_ == nullptr)
        return deviceError("libvulkan.so.1 is not a Vulkan loader");
    return success();
}

Status VulkanHost::createInstance(const HostOptions& options)
{
    const auto create_instance =
        reinterpret_cast<PFN_vkCreateInstance>(get_instance_proc_addr_(nullptr, "vkCreateInstance"));
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "hearth";
    application.apiVersion = VK_API_VERSION_1_1;

    VkDebugUtilsMessengerCreateInfoEXT messenger{};
    messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType =
        VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = collectMessage;
    messenger.pUserData = &messages_;
    const VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &messenger;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;

    std::vector<const char*> extensions;
    if (options.window != nullptr)
        extensions = options.window->instance_extensions;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    if (options.validate)
    {
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &kValidationLayer;
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    const VkResult result = create_instance(&info, nullptr, &instance_);
    if (result == VK_ERROR_LAYER_NOT_PRESENT)
        return deviceError("the validation layer is not installed (vulkan-validationlayers)");
    if (result != VK_SUCCESS)
        return deviceError("no Vulkan driver could be started (VkResult " + std::to_string(result) + ")");

#define HEARTH_LOAD(name) vk_->name = reinterpret_cast<PFN_##name>(get_instance_proc_addr_(instance_, #name));
    HEARTH_HOST_INSTANCE_FUNCTIONS(HEARTH_LOAD)
    HEARTH_LOAD(vkDestroySurfaceKHR)
    HEARTH_LOAD(vkGetPhysicalDeviceSurfaceSupportKHR)
    if (!options.validate)
        return success();
    HEARTH_LOAD(vkDestroyDebugUtilsMessengerEXT)
#undef HEARTH_LOAD
    const auto create_messenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        get_instance_proc_addr_(instance_, "vkCreateDebugUtilsMessengerEXT"));
    HEARTH_TRY_VK(create_messenger(instance_, &messenger, nullptr, &messenger_),
                  "listen to the validation layer");
    return success();
}

Status VulkanHost::chooseDevice(const std::string& name)
{
    uint32_t count = 0;
    vk_->vkEnumeratePhysicalDevices(instance_, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    vk_->vkEnumeratePhysicalDevices(instance_, &count, devices.data());

    int best = -1;
    std::string seen;
    for (const VkPhysicalDevice device : devices)
    {
        VkPhysicalDeviceProperties properties;
        vk_->vkGetPhysicalDeviceProperties(device, &properties);
        seen += (seen.empty() ? "" : ", ") + std::string(properties.deviceName);
        uint32_t family = 0;
        const bool matches = lowerCase(properties.deviceName).find(lowerCase(name)) != std::string::npos;
        if (!matches || properties.apiVersion < VK_API_VERSION_1_1 ||
            !findQueueFamily(*vk_, device, surface_, family) ||
            (surface_ != VK_NULL_HANDLE && !hasExtension(*vk_, device, VK_KHR_SWAPCHAIN_EXTENSION_NAME)) ||
            deviceTypeRank(properties.deviceType) <= best)
            continue;
        best = deviceTypeRank(properties.deviceType);
        physical_device_ = device;
        queue_family_ = family;
        device_name_ = properties.deviceName;
        software_ = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
        timestamp_period_ns_ = double{properties.limits.timestampPeriod};
    }
    if (physical_device_ == VK_NULL_HANDLE)
        return deviceError((name.empty() ? "no device has Vulkan 1.1"
                                         : "no device with Vulkan 1.1 is named \"" + name + "\"") +
                           (surface_ == VK_NULL_HANDLE ? "" : " and presents to the window") +
                           (seen.empty() ? "" : "; there are: " + seen));
    return success();
}

Status VulkanHost::createDevice()
{
    VkPhysicalDeviceFeatures supported;
    vk_->vkGetPhysicalDeviceFeatures(physical_device_, &supported);
    // lavapipe 22.3 filters anisotropically by the differences inside a 2x2 block, not by the explicit
    // gradients: wrong where the block sees two triangles, and a hundred times slower
    sampler_anisotropy_ = supported.samplerAnisotropy == VK_TRUE && !software_;
    VkPhysicalDeviceFeatures enabled{};
    enabled.samplerAnisotropy = sampler_anisotropy_ ? VK_TRUE : VK_FALSE;

    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = queue_family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.pEnabledFeatures = &enabled;
    std::vector<const char*> extensions;
    if (surface_ != VK_NULL_HANDLE)
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    // devices with the extension have its feature (Vulkan, "Feature Requirements")
    const char* const astc_hdr = VK_EXT_TEXTURE_COMPRESSION_ASTC_HDR_EXTENSION_NAME;
    astc_hdr_ = hasExtension(*vk_, physical_device_, astc_hdr);
    VkPhysicalDeviceTextureCompressionASTCHDRFeaturesEXT astc_hdr_feature{};
    astc_hdr_feature.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TEXTURE_COMPRESSION_ASTC_HDR_FEATURES_EXT;
    astc_hdr_feature.textureCompressionASTC_HDR = VK_TRUE;
    if (astc_hdr_)
    {
        extensions.push_back(astc_hdr);
        info.pNext = &astc_hdr_feature;
    }
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    HEARTH_TRY_VK(vk_->vkCreateDevice(physical_device_, &info, nullptr, &device_), "create a device");
#define HEARTH_LOAD(name) vk_->name = reinterpret_cast<PFN_##name>(vk_->vkGetDeviceProcAddr(device_, #name));
    HEARTH_HOST_DEVICE_FUNCTIONS(HEARTH_LOAD)
#undef HEARTH_LOAD
    vk_->vkGetDeviceQueue(device_, queue_family_, 0, &queue_);

    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = queue_family_;
    HEARTH_TRY_VK(vk_->vkCreateCommandPool(device_, &pool, nullptr, &command_pool_), "create a command pool");
    return success();
}

gpu::DeviceDescription VulkanHost::description() const
{
    return {.get_instance_proc_addr = get_instance_proc_addr_,
            .instance = instance_,
            .physical_device = physical_device_,
            .device = device_,
            .sampler_anisotropy = sampler_anisotropy_,
            .astc_hdr = astc_hdr_,
            .debug_labels = messenger_ != VK_NULL_HANDLE}; // messages then name the pass
}

Status VulkanHost::run(const std::function<Status(VkCommandBuffer)>& record)
{
    const VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr,
                                               command_pool_, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    VkCommandBuffer commands;
    HEARTH_TRY_VK(vk_->vkAllocateCommandBuffers(device_, &allocate, &commands), "allocate a command buffer");
    const Status ran = recordAndWait(commands, record);
    vk_->vkFreeCommandBuffers(device_, command_pool_, 1, &commands);
    return ran;
}

Status VulkanHost::recordAndWait(VkCommandBuffer commands,
                                 const std::function<Status(VkCommandBuffer)>& record)
{
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr,
                                         VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
    HEARTH_TRY_VK(vk_->vkBeginCommandBuffer(commands, &begin), "begin a command buffer");
    HEARTH_TRY(record(commands));
    HEARTH_TRY_VK(vk_->vkEndCommandBuffer(commands), "end a command buffer");

    const VkFenceCreateInfo fence_info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, 0};
    VkFence fence;
    HEARTH_TRY_VK(vk_->vkCreateFence(device_, &fence_info, nullptr, &fence), "create a fence");
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    VkResult result = vk_->vkQueueSubmit(queue_, 1, &submit, fence);
    if (result == VK_SUCCESS)
        result = vk_->vkWaitForFences(device_, 1, &fence, VK_TRUE, UINT64_MAX);
    vk_->vkDestroyFence(device_, fence, nullptr);
    HEARTH_TRY_VK(result, "run a command buffer");
    return success();
}

namespace
{

void makeVisibleToHost(const HostTable& vk, VkCommandBuffer commands)
{
    const VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_TRANSFER_WRITE_BIT,
                                 VK_ACCESS_HOST_READ_BIT};
    vk.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                            &memory, 0, nullptr, 0, nullptr);
}

} // namespace

Result<std::vector<std::byte>> VulkanHost::read(const gpu::Device& device, const gpu::Buffer& buffer)
{
    gpu::MemoryArena arena(device, 0);
    HEARTH_ASSIGN_OR_RETURN(
        const gpu::Buffer copy,
        arena.createBuffer(buffer.size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::MemoryKind::readback));
    HEARTH_TRY(run(
        [&](VkCommandBuffer commands)
        {
            const VkBufferCopy region{0, 0, buffer.size};
            vk_->vkCmdCopyBuffer(commands, buffer.handle.get(), copy.handle.get(), 1, &region);
            makeVisibleToHost(*vk_, commands);
            return success();
        }));
    return std::vector<std::byte>(copy.mapped, copy.mapped + buffer.size);
}

Result<std::vector<std::byte>> VulkanHost::read(const gpu::Device& device, const gpu::Image& image,
                                                uint32_t texel_bytes)
{
    const size_t size = size_t{image.extent.width} * image.extent.height * texel_bytes;
    gpu::MemoryArena arena(device, 0);
    HEARTH_ASSIGN_OR_RETURN(const gpu::Buffer copy, arena.createBuffer(size, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                                       gpu::MemoryKind::readback));
    HEARTH_TRY(run(
        [&](VkCommandBuffer commands)
        {
            VkBufferImageCopy region{};
            region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
            region.imageExtent = {image.extent.width, image.extent.height, 1};
            vk_->vkCmdCopyImageToBuffer(commands, image.handle.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                        copy.handle.get(), 1, &region);
            makeVisibleToHost(*vk_, commands);
            return success();
        }));
    return std::vector<std::byte>(copy.mapped, copy.mapped + size);
}

Result<std::vector<std::byte>> VulkanHost::readSampled(const gpu::Device& device, const gpu::Image& image,
                                                       uint32_t texel_bytes)
{
    const auto change = [&](VkImageLayout from, VkImageLayout to, VkPipelineStageFlags from_stage,
                            VkPipelineStageFlags to_stage)
    {
        return run(
            [&](VkCommandBuffer commands)
            {
                gpu::transition(device, commands, image, from, to, 0,
                                VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_SHADER_READ_BIT, from_stage,
                                to_stage | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT);
                return success();
            });
    };
    constexpr VkImageLayout kSampled = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    constexpr VkImageLayout kCopied = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    HEARTH_TRY(
        change(kSampled, kCopied, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT));
    HEARTH_ASSIGN_OR_RETURN(std::vector<std::byte> texels, read(device, image, texel_bytes));
    HEARTH_TRY(change(kCopied, kSampled, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT));
    return texels;
}

Status VulkanHost::printMessages() const
{
    for (const std::string& message : messages_)
        std::fprintf(stderr, "validation: %s\n", message.c_str());
    if (messages_.empty())
        return success();
    return Error{Issue::internal, device_name_, "",
                 "the validation layer has " + std::to_string(messages_.size()) + " messages"};
}

Result<std::vector<float>> VulkanHost::readDepth(const gpu::Device& device, const gpu::Image& image,
                                                 uint32_t layer)
{
    const bool is_float = image.format != VK_FORMAT_D16_UNORM;
    std::vector<float> depths(size_t{image.extent.width} * image.extent.height);
    const size_t size = depths.size() * (is_float ? sizeof(float) : sizeof(uint16_t));
    gpu::MemoryArena arena(device, 0);
    HEARTH_ASSIGN_OR_RETURN(const gpu::Buffer copy, arena.createBuffer(size, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                                       gpu::MemoryKind::readback));
    VkImageMemoryBarrier to_copy{};
    to_copy.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    to_copy.oldLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    to_copy.newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    to_copy.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
    to_copy.srcQueueFamilyIndex = to_copy.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    to_copy.image = image.handle.get();
    to_copy.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, layer, 1};
    VkImageMemoryBarrier back = to_copy;
    std::swap(back.oldLayout, back.newLayout);
    back.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
    HEARTH_TRY(run(
        [&](VkCommandBuffer commands)
        {
            vk_->vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
                                      VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 1, &to_copy);
            VkBufferImageCopy region{};
            region.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, layer, 1};
            region.imageExtent = {image.extent.width, image.extent.height, 1};
            vk_->vkCmdCopyImageToBuffer(commands, image.handle.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                        copy.handle.get(), 1, &region);
            vk_->vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                      VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 0, nullptr, 0, nullptr, 1,
                                      &back);
            makeVisibleToHost(*vk_, commands);
            return success();
        }));
    if (is_float)
        std::memcpy(depths.data(), copy.mapped, size);
    else
    {
        std::vector<uint16_t> steps(depths.size());
        std::memcpy(steps.data(), copy.mapped, size);
        std::transform(steps.begin(), steps.end(), depths.begin(),
                       [](uint16_t step) { return static_cast<float>(step) / 65535; });
    }
    return depths;
}

Result<VkQueryPool> VulkanHost::createTimestamps(uint32_t count)
{
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = count;
    VkQueryPool pool;
    HEARTH_TRY_VK(vk_->vkCreateQueryPool(device_, &info, nullptr, &pool), "create a query pool");
    query_pools_.push_back(pool);
    return pool;
}

Result<std::vector<double>> VulkanHost::readTimestamps(VkQueryPool pool, uint32_t count)
{
    std::vector<uint64_t> ticks(count);
    HEARTH_TRY_VK(vk_->vkGetQueryPoolResults(device_, pool, 0, count, ticks.size() * sizeof(uint64_t),
                                             ticks.data(), sizeof(uint64_t),
                                             VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                  "read timestamps");
    std::vector<double> milliseconds;
    for (const uint64_t tick : ticks)
        milliseconds.push_back(static_cast<double>(tick - ticks[0]) * timestamp_period_ns_ * 1e-6);
    return milliseconds;
}

} // namespace hearth::viewer
