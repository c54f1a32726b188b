// Swapchain: the images that a window shows in turn.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/viewer/vulkan_host.h"
#include "runtime/viewer/window/window_table.h"

#include <optional>

namespace hearth::viewer
{

/// State in which a frame leaves an image of the window: it is drawn over, or presented.
inline constexpr gpu::ImageState kDrawnImage{
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT};
/// Stage in which frames wait for an image of the window.
inline constexpr VkPipelineStageFlags kImageWait = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;

class Swapchain
{
public:
    /// Choose a format of the window that frames can have: 8 bits per channel, sRGB. errors: device if there
    /// is none.
    static Result<VkSurfaceFormatKHR> chooseFormat(const VulkanHost& host, const WindowTable& vk);

    /// Create without images: resize makes them. The arguments outlive it. errors: device if the window
    /// cannot show frames of the renderer; device_failed.
    static Result<std::unique_ptr<Swapchain>> create(const VulkanHost& host, const gpu::Device& device,
                                                     const WindowTable& vk, VkSurfaceFormatKHR format);
    ~Swapchain();

    /// Recreate the images at the size of the window. No frame is in flight.
    /// requested  pixels; used if the window system leaves the size to the application
    /// errors: device_failed.
    Status resize(VkExtent2D requested);

    /// 0 x 0: the window has no area, and there are no images.
    VkExtent2D extent() const { return extent_; }
    VkFormat format() const { return format_.format; }

    /// Acquire the next image; none if the window has changed and needs resize. errors: device_failed.
    Result<std::optional<uint32_t>> acquire(VkSemaphore available);
    /// Present the image when drawn(image) is signalled. False if the window has changed and needs resize.
    Result<bool> present(uint32_t image);

    VkImage image(uint32_t index) const { return images_[index].image; }
    /// Return all images, for targets whose frames draw them.
    gpu::CallerImages callerImages() const;
    VkSemaphore drawn(uint32_t index) const { return images_[index].drawn; }

    /// Render pass that draws over an image: expects it as kDrawnImage, and leaves it in the present layout.
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

    Swapchain(const VulkanHost& host, const gpu::Device& device, const WindowTable& vk,
              VkSurfaceFormatKHR format)
        : host_(host), device_(device), vk_(vk), format_(format)
    {
    }
    Status createOverlayPass();
    Status createSwapchain(const VkSurfaceCapabilitiesKHR& surface);
    Status createImage(VkImage image);
    void destroyImages();

    const VulkanHost& host_;
    const gpu::Device& device_;
    const WindowTable& vk_;
    VkSurfaceFormatKHR format_;
    gpu::UniqueRenderPass overlay_pass_;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    std::vector<Image> images_;
};

} // namespace hearth::viewer
