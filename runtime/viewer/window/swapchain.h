// The images that a window shows one after the other.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/vulkan_host.h"
#include "runtime/viewer/window/window_table.h"

#include <optional>

namespace hearth::viewer
{

class Swapchain
{
public:
    /// Without images: resize makes them. The arguments outlive it.
    /// errors: device, where the window cannot show a picture of the renderer; device_failed.
    static Result<std::unique_ptr<Swapchain>> create(const VulkanHost& host, const gpu::Device& device,
                                                     const WindowTable& vk);
    ~Swapchain();

    /// Images of the size of the window, in place of those before. No frame is under way.
    /// wanted  pixels; counts where the window system leaves the size to us
    /// errors: device_failed.
    Status resize(VkExtent2D wanted);

    /// 0 x 0: the window has no area, and there are no images.
    VkExtent2D extent() const { return extent_; }
    VkFormat format() const { return format_.format; } ///< eight bits a channel, sRGB

    /// The next image; none where the window has changed and wants resize. errors: device_failed.
    Result<std::optional<uint32_t>> acquire(VkSemaphore available);
    /// Show the image when drawn(image) is signalled. False: the window has changed and wants resize.
    Result<bool> present(uint32_t image);

    VkImage image(uint32_t index) const { return images_[index].image; }
    VkSemaphore drawn(uint32_t index) const { return images_[index].drawn; }

    /// A render pass that draws over an image: takes it in TRANSFER_DST_OPTIMAL behind a transfer, and leaves it in
    /// TRANSFER_SRC_OPTIMAL, visible to transfers.
    VkRenderPass overlayPass() const { return overlay_pass_.get(); }
    VkFramebuffer overlay(uint32_t index) const { return images_[index].framebuffer.get(); }

private:
    struct Image
    {
        VkImage image = VK_NULL_HANDLE;
        gpu::UniqueImageView view;
        gpu::UniqueFramebuffer framebuffer;
        VkSemaphore drawn = VK_NULL_HANDLE;
    };

    Swapchain(const VulkanHost& host, const gpu::Device& device, const WindowTable& vk)
        : host_(host), device_(device), vk_(vk)
    {
    }
    Status chooseFormat();
    Status createOverlayPass();
    Status createSwapchain(const VkSurfaceCapabilitiesKHR& surface);
    Status createImage(VkImage image);
    void destroyImages();

    const VulkanHost& host_;
    const gpu::Device& device_;
    const WindowTable& vk_;
    VkSurfaceFormatKHR format_{};
    gpu::UniqueRenderPass overlay_pass_;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    std::vector<Image> images_;
};

} // namespace hearth::viewer
