// Vulkan instance, device and queue, with a window or without: the objects that a game would own and pass to
// the renderer. Opens the loader at run time, so that a machine without Vulkan gets a message and not a
// linker error.
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

/// Callbacks of the window's owner.
struct HostWindow
{
    std::vector<const char*> instance_extensions;
    std::function<Result<VkSurfaceKHR>(VkInstance)> create_surface; ///< the host owns the surface
};

struct HostOptions
{
    std::string device_name; ///< part of the device's name, any case; empty: the fastest kind available
    bool validate = false;   ///< core and synchronization validation, collected in messages()
    const HostWindow* window = nullptr; ///< window to present to, with VK_KHR_swapchain; or null
};

/// Vulkan entry points that the host needs beside those of the renderer.
struct HostTable;

class VulkanHost
{
public:
    /// errors: device if there is no Vulkan, no such device, none that presents to the window, or no
    /// validation layer; errors of HostWindow::create_surface.
    static Result<std::unique_ptr<VulkanHost>> create(const HostOptions& options);
    ~VulkanHost();

    gpu::DeviceDescription description() const;
    const std::string& deviceName() const { return device_name_; }
    /// True for a software implementation such as lavapipe.
    bool software() const { return software_; }
    VkQueue queue() const { return queue_; }
    uint32_t queueFamily() const { return queue_family_; }
    VkSurfaceKHR surface() const { return surface_; } ///< of the window

    /// Record with `record`, submit and wait until the commands have run. Stops at the error of `record`.
    Status run(const std::function<Status(VkCommandBuffer)>& record);

    /// Read a buffer, which has usage TRANSFER_SRC.
    Result<std::vector<std::byte>> read(const gpu::Device& device, const gpu::Buffer& buffer);
    /// Read an image in layout TRANSFER_SRC_OPTIMAL, tightly packed, rows from top to bottom.
    Result<std::vector<std::byte>> read(const gpu::Device& device, const gpu::Image& image,
                                        uint32_t texel_bytes);

    /// Read an image in layout SHADER_READ_ONLY_OPTIMAL, which it keeps, in the same way.
    Result<std::vector<std::byte>> readSampled(const gpu::Device& device, const gpu::Image& image,
                                               uint32_t texel_bytes);

    /// Read a layer of a D32 array in layout SHADER_READ_ONLY_OPTIMAL, which it keeps, with usage
    /// TRANSFER_SRC; rows from top to bottom.
    Result<std::vector<float>> readDepth(const gpu::Device& device, const gpu::Image& image, uint32_t layer);

    /// Create a pool of `count` timestamps, which lives as long as the host.
    Result<VkQueryPool> createTimestamps(uint32_t count);
    /// Read timestamps as milliseconds since the first of them.
    Result<std::vector<double>> readTimestamps(VkQueryPool pool, uint32_t count);

    /// Messages of the validation layers. Must be empty.
    const std::vector<std::string>& messages() const { return messages_; }
    /// Print each message on stderr. errors: internal if there are any.
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
    bool astc_hdr_ = false;
    bool software_ = false;
    double timestamp_period_ns_ = 1;
    std::string device_name_;
    std::vector<std::string> messages_;
};

} // namespace hearth::viewer
