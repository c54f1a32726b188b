// Vulkan entry points that a window needs beside those of the renderer.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/device.h"

#define HEARTH_WINDOW_INSTANCE_FUNCTIONS(X)                                                                  \
    X(vkGetPhysicalDeviceSurfaceCapabilitiesKHR)                                                             \
    X(vkGetPhysicalDeviceSurfaceFormatsKHR)

#define HEARTH_WINDOW_DEVICE_FUNCTIONS(X)                                                                    \
    X(vkAcquireNextImageKHR)                                                                                 \
    X(vkAllocateCommandBuffers)                                                                              \
    X(vkBeginCommandBuffer)                                                                                  \
    X(vkCmdCopyImageToBuffer)                                                                                \
    X(vkCreateCommandPool)                                                                                   \
    X(vkCreateFence)                                                                                         \
    X(vkCreateSemaphore)                                                                                     \
    X(vkCreateSwapchainKHR)                                                                                  \
    X(vkDestroyCommandPool)                                                                                  \
    X(vkDestroyFence)                                                                                        \
    X(vkDestroySemaphore)                                                                                    \
    X(vkDestroySwapchainKHR)                                                                                 \
    X(vkDeviceWaitIdle)                                                                                      \
    X(vkEndCommandBuffer)                                                                                    \
    X(vkGetSwapchainImagesKHR)                                                                               \
    X(vkQueuePresentKHR)                                                                                     \
    X(vkQueueSubmit)                                                                                         \
    X(vkResetFences)                                                                                         \
    X(vkWaitForFences)

namespace hearth::viewer
{

struct WindowTable
{
#define HEARTH_MEMBER(name) PFN_##name name = nullptr;
    HEARTH_WINDOW_INSTANCE_FUNCTIONS(HEARTH_MEMBER)
    HEARTH_WINDOW_DEVICE_FUNCTIONS(HEARTH_MEMBER)
#undef HEARTH_MEMBER
};

/// Load from a device with VK_KHR_swapchain. errors: device if an entry point is missing.
Result<WindowTable> loadWindowTable(const gpu::DeviceDescription& device);

} // namespace hearth::viewer
