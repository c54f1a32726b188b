// A Vulkan instance, device and queue, with a window or without: what a game would own and hand to the renderer.
// The loader is opened at run time, so that a machine without Vulkan gets a message and not a linker error.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "runtime/gpu/renderer.h"
#include "runtime/gpu/vulkan/memory.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hearth::viewer
{

/// What whoever owns a window says of it.
struct HostWindow
{
    std::vector<const char*> instance_extensions;
    std::function<Result<VkSurfaceKHR>(VkInstance)> create_surface; ///< the surface becomes the host's
};

struct HostOptions
{
    std::string device_name; ///< part of the device's name, any case; empty: the fastest kind there is
    bool validate = false;   ///< core and synchronization validation, collected in messages()
    const HostWindow* window = nullptr; ///< where the queue shall present to one: with VK_KHR_swapchain
};

/// Vulkan entry points that the host needs beside those of the renderer.
struct HostTable;

class VulkanHost
{
public:
    /// errors: device, where there is no Vulkan, no such device, none that presents to the window, or no validation layer;
    /// those of HostWindow::create_surface.
    static Result<std::unique_ptr<VulkanHost>> create(const HostOptions& options);
    ~VulkanHost();

    gpu::DeviceDescription description() const;
    const std::string& deviceName() const { return device_name_; }
    /// A software implementation, as lavapipe.
    bool software() const { return software_; }
    VkQueue queue() const { return queue_; }
    uint32_t queueFamily() const { return queue_family_; }
    VkSurfaceKHR surface() const { return surface_; } ///< of the window

    /// Let `record` fill a command buffer, submit it and wait until it has run. Stops at the error of `record`.
    Status run(const std::function<Status(VkCommandBuffer)>& record);

    /// Bytes of a buffer, which has usage TRANSFER_SRC.
    Result<std::vector<std::byte>> read(const gpu::Device& device, const gpu::Buffer& buffer);
    /// Texels of an image in layout TRANSFER_SRC_OPTIMAL, tightly packed, rows top to bottom.
    Result<std::vector<std::byte>> read(const gpu::Device& device, const gpu::Image& image,
                                        uint32_t texel_bytes);

    /// A layer of an array of D32 in layout SHADER_READ_ONLY_OPTIMAL, where it stays, with usage TRANSFER_SRC; rows top to
    /// bottom.
    Result<std::vector<float>> readDepth(const gpu::Device& device, const gpu::Image& image, uint32_t layer);

    /// A pool of `count` timestamps, which lives as long as the host.
    Result<VkQueryPool> createTimestamps(uint32_t count);
    /// Milliseconds since the first of them.
    Result<std::vector<double>> readTimestamps(VkQueryPool pool, uint32_t count);

    /// What the validation layers said, one message each. Empty is the only good answer.
    const std::vector<std::string>& messages() const { return messages_; }
    /// Each on stderr. errors: internal, where there are any.
    Status printMessages() const;
    void clearMessages() { messages_.clear(); }

private:
    VulkanHost();
    Status openLoader();
    Status createInstance(const HostOptions& options);
    Status chooseDevice(const std::string& name);
    Status createDevice();
    Status recordAndWait(VkCommandBuffer commands, const std::function<Status(VkCommandBuffer)>& record);

    std::unique_ptr<HostTable> vk_;
    void* library_ = nullptr;
    PFN_vkGetInstanceProcAddr get_instance_proc_addr_ = nullptr;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
    uint32_t queue_family_ = 0;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool command_pool_ = VK_NULL_HANDLE;
    std::vector<VkQueryPool> query_pools_;
    bool sampler_anisotropy_ = false;
    bool software_ = false;
    double timestamp_period_ns_ = 1;
    std::string device_name_;
    std::vector<std::string> messages_;
};

} // namespace hearth::viewer
