// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "gpu.h"

#include <SDL.h>
#include <SDL_vulkan.h>
#include <vector>

namespace game
{

Gpu::Gpu(SDL_Window* window)
{
    createInstance(window);
    createDevice();
    VkCommandPool pool = VK_NULL_HANDLE;
    const VkCommandPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                            .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                            .queueFamilyIndex = family};
    check(vkCreateCommandPool(device, &pool_info, nullptr, &pool));
    const VkCommandBufferAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                               .commandPool = pool,
                                               .commandBufferCount = kFramesInFlight};
    check(vkAllocateCommandBuffers(device, &allocate, commands_.data()));
    const VkFenceCreateInfo fence{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO,
                                  .flags = VK_FENCE_CREATE_SIGNALED_BIT};
    for (VkFence& done : fences_)
        check(vkCreateFence(device, &fence, nullptr, &done));
}

void Gpu::createInstance(SDL_Window* window)
{
    unsigned count = 0;
    std::vector<const char*> extensions;
    if (window != nullptr)
    {
        check(SDL_Vulkan_GetInstanceExtensions(window, &count, nullptr) == SDL_TRUE, SDL_GetError());
        extensions.resize(count);
        SDL_Vulkan_GetInstanceExtensions(window, &count, extensions.data());
    }
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .apiVersion = VK_API_VERSION_1_1};
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pApplicationInfo = &application,
                                    .enabledExtensionCount = count,
                                    .ppEnabledExtensionNames = extensions.data()};
    check(vkCreateInstance(&info, nullptr, &instance));
    if (window != nullptr)
        check(SDL_Vulkan_CreateSurface(window, instance, &surface) == SDL_TRUE, SDL_GetError());
}

void Gpu::createDevice()
{
    uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance, &count, nullptr));
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance, &count, devices.data()));
    bool is_found = false;
    for (size_t i = 0; i < devices.size() && !is_found; ++i)
    {
        physical = devices[i];
        is_found = findQueue();
    }
    check(is_found, "there is no Vulkan device");

    VkPhysicalDeviceFeatures available, features{};
    vkGetPhysicalDeviceFeatures(physical, &available);
    features.samplerAnisotropy = available.samplerAnisotropy;
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue_info{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                             .queueFamilyIndex = family,
                                             .queueCount = 1,
                                             .pQueuePriorities = &priority};
    const char* const swapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue_info,
                                  .enabledExtensionCount = surface != VK_NULL_HANDLE ? 1u : 0u,
                                  .ppEnabledExtensionNames = &swapchain,
                                  .pEnabledFeatures = &features};
    check(vkCreateDevice(physical, &info, nullptr, &device));
    vkGetDeviceQueue(device, family, 0, &queue);
}

bool Gpu::findQueue()
{
    constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    for (family = 0; family < count; ++family)
    {
        VkBool32 can_show = VK_TRUE;
        if (surface != VK_NULL_HANDLE)
            vkGetPhysicalDeviceSurfaceSupportKHR(physical, family, surface, &can_show);
        if ((families[family].queueFlags & kNeeded) == kNeeded && can_show == VK_TRUE)
            return true;
    }
    return false;
}

Buffer Gpu::createBuffer(VkDeviceSize size, VkBufferUsageFlags usage) const
{
    constexpr VkMemoryPropertyFlags kMapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    Buffer made;
    const VkBufferCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size, .usage = usage};
    check(vkCreateBuffer(device, &info, nullptr, &made.buffer));
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device, made.buffer, &needs);
    VkPhysicalDeviceMemoryProperties types;
    vkGetPhysicalDeviceMemoryProperties(physical, &types);
    // every device has such a type for buffers
    uint32_t type = 0;
    while ((needs.memoryTypeBits >> type & 1) == 0 ||
           (types.memoryTypes[type].propertyFlags & kMapped) != kMapped)
        ++type;
    const VkMemoryAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                        .allocationSize = needs.size,
                                        .memoryTypeIndex = type};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(device, &allocate, nullptr, &memory));
    check(vkBindBufferMemory(device, made.buffer, memory, 0));
    check(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &made.mapped));
    return made;
}

VkCommandBuffer Gpu::begin()
{
    ++serial_;
    check(vkWaitForFences(device, 1, &fences_[slot()], VK_TRUE, UINT64_MAX));
    if (serial_ > completed_ + kFramesInFlight)
        completed_ = serial_ - kFramesInFlight;
    const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    check(vkBeginCommandBuffer(commands_[slot()], &info));
    return commands_[slot()];
}

void Gpu::submit(VkSemaphore wait, VkSemaphore signal)
{
    check(vkEndCommandBuffer(commands_[slot()]));
    check(vkResetFences(device, 1, &fences_[slot()]));
    const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_TRANSFER_BIT;
    const VkSubmitInfo info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                            .waitSemaphoreCount = wait != VK_NULL_HANDLE ? 1u : 0u,
                            .pWaitSemaphores = &wait,
                            .pWaitDstStageMask = &stage,
                            .commandBufferCount = 1,
                            .pCommandBuffers = &commands_[slot()],
                            .signalSemaphoreCount = signal != VK_NULL_HANDLE ? 1u : 0u,
                            .pSignalSemaphores = &signal};
    check(vkQueueSubmit(queue, 1, &info, fences_[slot()]));
}

void Gpu::waitForAll()
{
    check(vkDeviceWaitIdle(device));
    completed_ = serial_;
}

} // namespace game
