// Command buffers and fences of the frames in flight.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/vulkan_host.h"
#include "runtime/viewer/window/window_table.h"

#include <array>

namespace hearth::viewer
{

/// One frame is recorded while the other is drawn.
inline constexpr uint32_t kFramesInFlight = 2;

/// Ring of frame slots. For each frame: wait, begin, submit.
class FrameRing
{
public:
    /// The arguments outlive the ring. errors: device_failed.
    static Result<std::unique_ptr<FrameRing>> create(const VulkanHost& host, const gpu::Device& device,
                                                     const WindowTable& vk);
    /// No frame is in flight.
    ~FrameRing();

    uint32_t slot() const
    {
        return static_cast<uint32_t>((serial_ + 1) % kFramesInFlight);
        /// Slot of the next frame.
    }
    uint64_t serial() const { return serial_; } ///< of the last frame; the first is 1
    /// all frames up to this one have completed
    uint64_t completedSerial() const { return completed_serial_; }

    /// Wait until the frame that had the slot before has completed. errors: device_failed.
    Status wait();
    /// Semaphore to signal when the frame may draw to its swapchain image.
    VkSemaphore available() const { return slots_[slot()].available; }
    /// errors: device_failed.
    Result<VkCommandBuffer> begin();
    /// Submit. The transfers wait for available(); `drawn` is signalled when everything is done. errors:
    /// device_failed.
    Status submit(VkSemaphore drawn);

    /// Wait until no frame is in flight. errors: device_failed.
    Status waitForAll();

private:
    struct Slot
    {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkFence done = VK_NULL_HANDLE;
        VkSemaphore available = VK_NULL_HANDLE;
    };

    FrameRing(const VulkanHost& host, const gpu::Device& device, const WindowTable& vk)
        : host_(host), device_(device.handle), vk_(vk)
    {
    }

    const VulkanHost& host_;
    VkDevice device_;
    const WindowTable& vk_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    std::array<Slot, kFramesInFlight> slots_;
    uint64_t serial_ = 0;
    uint64_t completed_serial_ = 0;
};

} // namespace hearth::viewer
