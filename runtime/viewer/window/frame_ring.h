// Command buffers and fences of the frames that run at once.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/vulkan_host.h"
#include "runtime/viewer/window/window_table.h"

#include <array>

namespace hearth::viewer
{

/// One is recorded while the other is drawn.
inline constexpr uint32_t kFramesInFlight = 2;

/// For each frame: wait, begin, submit. The slots are taken in turn.
class FrameRing
{
public:
    /// The arguments outlive it. errors: device_failed.
    static Result<std::unique_ptr<FrameRing>> create(const VulkanHost& host, const gpu::Device& device,
                                                     const WindowTable& vk);
    /// No frame is under way.
    ~FrameRing();

    uint32_t slot() const
    {
        return static_cast<uint32_t>((serial_ + 1) % kFramesInFlight);
    }                                                              ///< the next frame's
    uint64_t serial() const { return serial_; }                    ///< of the last frame, the first is 1
    uint64_t completedSerial() const { return completed_serial_; } ///< no frame up to this one runs any more

    /// Until the frame that had the slot before has run. errors: device_failed.
    Status wait();
    /// To be signalled when the frame may be drawn to what it presents.
    VkSemaphore available() const { return slots_[slot()].available; }
    /// errors: device_failed.
    Result<VkCommandBuffer> begin();
    /// Its transfers wait for available(); `drawn` is signalled when all is done. errors: device_failed.
    Status submit(VkSemaphore drawn);

    /// Until no frame runs. errors: device_failed.
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
