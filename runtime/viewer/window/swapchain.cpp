// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/swapchain.h"

#include <algorithm>

namespace hearth::viewer
{

using gpu::vulkanError;

namespace
{

// frames and the panel draw to it; screenshots read it
constexpr VkImageUsageFlags kUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;

VkSurfaceCapabilitiesKHR queryCapabilities(const VulkanHost& host, const WindowTable& vk)
{
    VkSurfaceCapabilitiesKHR surface{};
    vk.vkGetPhysicalDeviceSurfaceCapabilitiesKHR(host.description().physical_device, host.surface(),
                                                 &surface);
    return surface;
}

/// Return the window's own size, or the requested size if the surface accepts any.
VkExtent2D chooseExtent(const VkSurfaceCapabilitiesKHR& surface, VkExtent2D requested)
{
    constexpr uint32_t kAny = 0xffffffff;
    if (surface.currentExtent.width != kAny)
        return surface.currentExtent;
    const VkExtent2D least = surface.minImageExtent, most = surface.maxImageExtent;
    return {std::clamp(requested.width, least.width, most.width),
            std::clamp(requested.height, least.height, most.height)};
}

} // namespace

Result<std::unique_ptr<Swapchain>> Swapchain::create(const VulkanHost& host, const gpu::Device& device,
                                                     const WindowTable& vk, VkSurfaceFormatKHR format)
{
    std::unique_ptr<Swapchain> swapchain(new Swapchain(host, device, vk, format));
    if ((queryCapabilities(host, vk).supportedUsageFlags & kUsage) != kUsage)
        return Error{Issue::device, "", "", "images of the window cannot be drawn and copied from"};
    HEARTH_TRY(swapchain->createOverlayPass());
    return swapchain;
}

Swapchain::~Swapchain()
{
    destroyImages();
    if (swapchain_ != VK_NULL_HANDLE)
        vk_.vkDestroySwapchainKHR(device_.handle, swapchain_, nullptr);
}

gpu::CallerImages Swapchain::callerImages() const
{
    gpu::CallerImages images{.before = {VK_IMAGE_LAYOUT_UNDEFINED, kImageWait, 0}, .after = kDrawnImage};
    for (const Image& image : images_)
        images.images.push_back(image.image);
    return images;
}

Result<VkSurfaceFormatKHR> Swapchain::chooseFormat(const VulkanHost& host, const WindowTable& vk)
{
    uint32_t count = 0;
    const VkPhysicalDevice physical_device = host.description().physical_device;
    vk.vkGetPhysicalDeviceSurfaceFormatsKHR(physical_device, host.surface(), &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    vk.vkGetPhysicalDeviceSurfaceFormatsKHR(physical_device, host.surface(), &count, formats.data());
    const auto found = std::find_if(formats.begin(), formats.end(),
                                    [](const VkSurfaceFormatKHR& format) {
                                        return format.format == VK_FORMAT_B8G8R8A8_SRGB ||
                                               format.format == VK_FORMAT_R8G8B8A8_SRGB;
                                    });
    if (found == formats.end())
        return Error{Issue::device, "", "", "the window shows no sRGB images"};
    return *found;
}

Status Swapchain::createOverlayPass()
{
    VkAttachmentDescription attachment{};
    attachment.format = format_.format;
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachment.initialLayout = kDrawnImage.layout;
    attachment.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    constexpr VkSubpassDependency kDependencies[] = {
        {VK_SUBPASS_EXTERNAL, 0, kDrawnImage.stages, kDrawnImage.stages, kDrawnImage.access,
         kDrawnImage.access, 0},
        {0, VK_SUBPASS_EXTERNAL, kDrawnImage.stages, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT,
         VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, 0, 0}};
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = &attachment;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<uint32_t>(std::size(kDependencies));
    info.pDependencies = kDependencies;
    VkRenderPass pass;
    HEARTH_TRY_VK(device_.vk.vkCreateRenderPass(device_.handle, &info, device_.allocator, &pass),
                  "create a render pass");
    overlay_pass_ = gpu::UniqueRenderPass(device_, pass);
    return success();
}

Status Swapchain::resize(VkExtent2D requested)
{
    const VkSurfaceCapabilitiesKHR surface = queryCapabilities(host_, vk_);
    destroyImages();
    extent_ = chooseExtent(surface, requested);
    if (extent_.width == 0 || extent_.height == 0)
    {
        extent_ = {};
        return success();
    }
    HEARTH_TRY(createSwapchain(surface));
    uint32_t count = 0;
    vk_.vkGetSwapchainImagesKHR(device_.handle, swapchain_, &count, nullptr);
    std::vector<VkImage> images(count);
    HEARTH_TRY_VK(vk_.vkGetSwapchainImagesKHR(device_.handle, swapchain_, &count, images.data()),
                  "get the images of the window");
    for (const VkImage image : images)
        HEARTH_TRY(createImage(image));
    return success();
}

Status Swapchain::createSwapchain(const VkSurfaceCapabilitiesKHR& surface)
{
    // one image more than the system holds back, so that one is always available
    const uint32_t count = surface.minImageCount + 1;
    VkSwapchainCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    info.surface = host_.surface();
    info.minImageCount = surface.maxImageCount == 0 ? count : std::min(count, surface.maxImageCount);
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
    info.imageExtent = extent_;
    info.imageArrayLayers = 1;
    info.imageUsage = kUsage;
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = surface.currentTransform;
    info.compositeAlpha = (surface.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0
                              ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                              : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR; // the only mode that every device has
    info.clipped = VK_FALSE;                     // screenshots need all pixels
    info.oldSwapchain = swapchain_;
    VkSwapchainKHR swapchain = VK_NULL_HANDLE;
    const VkResult result = vk_.vkCreateSwapchainKHR(device_.handle, &info, nullptr, &swapchain);
    if (swapchain_ != VK_NULL_HANDLE)
        vk_.vkDestroySwapchainKHR(device_.handle, swapchain_, nullptr);
    swapchain_ = swapchain;
    HEARTH_TRY_VK(result, "create a swapchain");
    return success();
}

Status Swapchain::createImage(VkImage image)
{
    Image& made = images_.emplace_back();
    made.image = image;
    VkImageViewCreateInfo view_info{};
    view_info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view_info.image = image;
    view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view_info.format = format_.format;
    view_info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkImageView view;
    HEARTH_TRY_VK(device_.vk.vkCreateImageView(device_.handle, &view_info, device_.allocator, &view),
                  "create an image view");
    made.view = gpu::UniqueImageView(device_, view);

    VkFramebufferCreateInfo framebuffer_info{};
    framebuffer_info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    framebuffer_info.renderPass = overlay_pass_.get();
    framebuffer_info.attachmentCount = 1;
    framebuffer_info.pAttachments = &view;
    framebuffer_info.width = extent_.width;
    framebuffer_info.height = extent_.height;
    framebuffer_info.layers = 1;
    VkFramebuffer framebuffer;
    HEARTH_TRY_VK(
        device_.vk.vkCreateFramebuffer(device_.handle, &framebuffer_info, device_.allocator, &framebuffer),
        "create a framebuffer");
    made.framebuffer = gpu::UniqueFramebuffer(device_, framebuffer);

    const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, nullptr, 0};
    HEARTH_TRY_VK(vk_.vkCreateSemaphore(device_.handle, &semaphore, nullptr, &made.drawn),
                  "create a semaphore");
    return success();
}

void Swapchain::destroyImages()
{
    for (const Image& image : images_)
        if (image.drawn != VK_NULL_HANDLE)
            vk_.vkDestroySemaphore(device_.handle, image.drawn, nullptr);
    images_.clear();
}

Result<std::optional<uint32_t>> Swapchain::acquire(VkSemaphore available)
{
    uint32_t image = 0;
    const VkResult result =
        vk_.vkAcquireNextImageKHR(device_.handle, swapchain_, UINT64_MAX, available, VK_NULL_HANDLE, &image);
    if (result == VK_ERROR_OUT_OF_DATE_KHR)
        return std::optional<uint32_t>();
    // an image that no longer fits well is drawn all the same: its semaphore will be signalled
    if (result != VK_SUBOPTIMAL_KHR)
        HEARTH_TRY_VK(result, "get the next image of the window");
    return std::optional<uint32_t>(image);
}

Result<bool> Swapchain::present(uint32_t image)
{
    VkPresentInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &images_[image].drawn;
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain_;
    info.pImageIndices = &image;
    const VkResult result = vk_.vkQueuePresentKHR(host_.queue(), &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR)
        return false;
    HEARTH_TRY_VK(result, "show an image");
    return true;
}

} // namespace hearth::viewer
