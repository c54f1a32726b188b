// Vulkan device of the game, its command buffers, two frames in flight.
// Nothing of Vulkan is destroyed before the process ends; objects of Hearth are, before the device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "check.h"

#include <array>

struct SDL_Window;

namespace game
{

inline constexpr uint32_t kFramesInFlight = 2;

struct Buffer
{
    VkBuffer buffer = VK_NULL_HANDLE;
    void* mapped = nullptr;
};

class Gpu
{
public:
    /// window  to draw to; null: none
    explicit Gpu(SDL_Window* window);

    /// Create a buffer that both processors read and write.
    Buffer createBuffer(VkDeviceSize size, VkBufferUsageFlags usage) const;
    /// Begin the commands of the next frame, once the one before the last has completed.
    VkCommandBuffer begin();
    /// wait, signal  or null; the commands wait where they write to the window
    void submit(VkSemaphore wait = VK_NULL_HANDLE, VkSemaphore signal = VK_NULL_HANDLE);
    void waitForAll();

    uint64_t serial() const { return serial_; }       ///< of the frame that begin() began, from 1 on
    uint64_t completed() const { return completed_; } ///< all frames up to this one have completed
    uint32_t slot() const { return static_cast<uint32_t>(serial_ % kFramesInFlight); }

    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    uint32_t family = 0; ///< of the queue: graphics, compute, and the window
    VkQueue queue = VK_NULL_HANDLE;
    VkSurfaceKHR surface = VK_NULL_HANDLE;

private:
    void createInstance(SDL_Window* window);
    void createDevice();
    bool findQueue();

    std::array<VkCommandBuffer, kFramesInFlight> commands_{};
    std::array<VkFence, kFramesInFlight> fences_{};
    uint64_t serial_ = 0, completed_ = 0;
};

} // namespace game
