// The caller's Vulkan device as the renderer uses it, and owning handles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "formats/records/texel_format.h"
#include "runtime/gpu/vulkan/device_limits.h"
#include "runtime/gpu/vulkan/memory_hooks.h"

#include <bitset>
#include <string>
#include <string_view>
#include <utility>

namespace hearth::gpu
{

/// Callback for warnings about degraded results that are no error: lights left out, pages that cannot be
/// read.
struct MessageHook
{
    void* user = nullptr;
    /// Gets one line, formatted like an error, on the thread of the call that finds it; must not call the
    /// library.
    void (*warn)(void* user, const char* message) = nullptr;
};

/// Objects that the caller created and keeps alive longer than everything created from them. Vulkan 1.1; no
/// optional feature is required. Uses those that the caller enabled and sets the flags of.
struct DeviceDescription
{
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    bool sampler_anisotropy = false;
    /// textureCompressionASTC_HDR, of VK_EXT_texture_compression_astc_hdr
    bool astc_hdr = false;
    /// The caller enabled VK_EXT_debug_utils: passes are named in command buffers.
    bool debug_labels = false;
    const VkAllocationCallbacks* allocator = nullptr;
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE; ///< for all pipelines
    MemoryHooks memory_hooks{};                      ///< none: the library allocates blocks of its own
    MessageHook message_hook{};
    /// Give the driver the part of each shader that a pipeline needs (specialized_shader.h); false: whole
    /// modules and their specialization constants, for tools that know modules by their words.
    bool specializes_shaders = true;
};

/// Maker and name of a device.
struct DeviceIdentity
{
    uint32_t vendor = 0; ///< of the PCI, or of Khronos
    std::string name;
};

/// Device of the renderer. Everything else holds a reference to it, so it must not move once it is used.
struct Device
{
    DeviceTable vk;
    VkDevice handle = VK_NULL_HANDLE;
    const VkAllocationCallbacks* allocator = nullptr;
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;
    MemoryHooks memory_hooks{};
    MessageHook message_hook{};
    bool specializes_shaders = true;
    bool sampler_anisotropy = false;
    /// [TexelFormat]: textures may have the format and be filtered. Features for compressed formats need not
    /// be enabled, but for ASTC of floats.
    std::bitset<formats::kTexelFormatEnd> texel_formats{};
    /// Compares with depth images of these formats may be bilinear, which Vulkan does not require.
    bool filters_d16 = false;
    bool filters_d32 = false;
    /// Images with B10G11R11_UFLOAT can be drawn to and blended, which Vulkan does not require.
    bool draws_packed_floats = false;
    DeviceIdentity identity{};
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMemoryProperties memory{};
};

/// errors: device if an entry point, a limit or a format is missing: requiredLimits(), requiredFormats().
Result<Device> makeDevice(const DeviceDescription& description,
                          std::span<const RequiredFormat> more_formats = {});

/// Warn the caller that something is degraded. Allocates only if the caller has set a hook; without memory
/// for the text there is no warning.
void warn(const Device& device, const std::string& name, const std::string& where,
          std::string_view what) noexcept;

/// Make the Error of a Vulkan call that failed: device_failed, or device_lost, device_memory, out_of_memory
/// (of the host) by its result. Functions that say device_failed may return each of them.
/// what  names the operation
Error vulkanError(VkResult result, const char* what);

/// Owns one Vulkan object.
template <typename T, auto kDestroy>
class Unique
{
public:
    Unique() = default;
    Unique(const Device& device, T handle) : device_(&device), handle_(handle) {}
    Unique(Unique&& other) noexcept
        : device_(other.device_), handle_(std::exchange(other.handle_, VK_NULL_HANDLE))
    {
    }
    Unique& operator=(Unique&& other) noexcept
    {
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Unique()
    {
        if (handle_ != VK_NULL_HANDLE)
            (device_->vk.*kDestroy)(device_->handle, handle_, device_->allocator);
    }

    T get() const { return handle_; }
    const T* address() const { return &handle_; }

private:
    const Device* device_ = nullptr;
    T handle_ = VK_NULL_HANDLE;
};

using UniqueBuffer = Unique<VkBuffer, &DeviceTable::vkDestroyBuffer>;
using UniqueDescriptorPool = Unique<VkDescriptorPool, &DeviceTable::vkDestroyDescriptorPool>;
using UniqueFramebuffer = Unique<VkFramebuffer, &DeviceTable::vkDestroyFramebuffer>;
using UniqueImage = Unique<VkImage, &DeviceTable::vkDestroyImage>;
using UniqueImageView = Unique<VkImageView, &DeviceTable::vkDestroyImageView>;
using UniqueMemory = Unique<VkDeviceMemory, &DeviceTable::vkFreeMemory>;
using UniquePipeline = Unique<VkPipeline, &DeviceTable::vkDestroyPipeline>;
using UniquePipelineLayout = Unique<VkPipelineLayout, &DeviceTable::vkDestroyPipelineLayout>;
using UniqueRenderPass = Unique<VkRenderPass, &DeviceTable::vkDestroyRenderPass>;
using UniqueSampler = Unique<VkSampler, &DeviceTable::vkDestroySampler>;
using UniqueSetLayout = Unique<VkDescriptorSetLayout, &DeviceTable::vkDestroyDescriptorSetLayout>;
using UniqueShaderModule = Unique<VkShaderModule, &DeviceTable::vkDestroyShaderModule>;

} // namespace hearth::gpu

/// Return an Error from the function if a Vulkan call does not return VK_SUCCESS.
#define HEARTH_TRY_VK(call, what)                                                                            \
    do                                                                                                       \
    {                                                                                                        \
        if (const VkResult hearth_vk_result = (call); hearth_vk_result != VK_SUCCESS)                        \
            return ::hearth::gpu::vulkanError(hearth_vk_result, what);                                       \
    } while (false)
