// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "screen.h"

#include <SDL_vulkan.h>
#include <algorithm>
#include <backends/imgui_impl_sdl.h>
#include <backends/imgui_impl_vulkan.h>
#include <cmath>
#include <imgui.h>

namespace game
{

Screen::Screen(Gpu& gpu, SDL_Window* window) : gpu_(gpu), window_(window)
{
    uint32_t count = 0;
    vkGetPhysicalDeviceSurfaceFormatsKHR(gpu.physical, gpu.surface, &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    vkGetPhysicalDeviceSurfaceFormatsKHR(gpu.physical, gpu.surface, &count, formats.data());
    const auto is_srgb = [](const VkSurfaceFormatKHR& format)
    { return format.format == VK_FORMAT_B8G8R8A8_SRGB || format.format == VK_FORMAT_R8G8B8A8_SRGB; };
    const auto found = std::find_if(formats.begin(), formats.end(), is_srgb);
    check(found != formats.end(), "the window shows no sRGB images");
    format_ = *found;
    createPass();
    createSwapchain();
    const VkSemaphoreCreateInfo semaphore{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    for (VkSemaphore& available : available_)
        check(vkCreateSemaphore(gpu.device, &semaphore, nullptr, &available));

    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // no file of settings
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableGamepad;
    for (ImVec4& color : ImGui::GetStyle().Colors) // they are sRGB, and the window's images linear
        color = {std::pow(color.x, 2.2f), std::pow(color.y, 2.2f), std::pow(color.z, 2.2f), color.w};
    ImGui_ImplSDL2_InitForVulkan(window);
    const VkDescriptorPoolSize textures{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
    const VkDescriptorPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = 1,
                                          .poolSizeCount = 1,
                                          .pPoolSizes = &textures};
    ImGui_ImplVulkan_InitInfo info{};
    check(vkCreateDescriptorPool(gpu.device, &pool, nullptr, &info.DescriptorPool));
    info.Instance = gpu.instance;
    info.PhysicalDevice = gpu.physical;
    info.Device = gpu.device;
    info.QueueFamily = gpu.family;
    info.Queue = gpu.queue;
    info.MinImageCount = info.ImageCount = kFramesInFlight;
    ImGui_ImplVulkan_Init(&info, pass_);
    ImGui_ImplVulkan_CreateFontsTexture(gpu.begin());
    gpu.submit();
    gpu.waitForAll();
    ImGui_ImplVulkan_DestroyFontUploadObjects();
}

void Screen::createPass()
{
    const VkAttachmentDescription attachment{0,
                                             format_.format,
                                             VK_SAMPLE_COUNT_1_BIT,
                                             VK_ATTACHMENT_LOAD_OP_LOAD,
                                             VK_ATTACHMENT_STORE_OP_STORE,
                                             VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                             VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                             VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                             VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass{.colorAttachmentCount = 1, .pColorAttachments = &color};
    const VkSubpassDependency dependency{VK_SUBPASS_EXTERNAL,
                                         0,
                                         VK_PIPELINE_STAGE_TRANSFER_BIT,
                                         VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                                         VK_ACCESS_TRANSFER_WRITE_BIT,
                                         VK_ACCESS_COLOR_ATTACHMENT_READ_BIT |
                                             VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                                         0};
    const VkRenderPassCreateInfo info{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                      .attachmentCount = 1,
                                      .pAttachments = &attachment,
                                      .subpassCount = 1,
                                      .pSubpasses = &subpass,
                                      .dependencyCount = 1,
                                      .pDependencies = &dependency};
    check(vkCreateRenderPass(gpu_.device, &info, nullptr, &pass_));
}

void Screen::createSwapchain()
{
    gpu_.waitForAll();
    for (const Image& image : images_)
    {
        vkDestroyFramebuffer(gpu_.device, image.framebuffer, nullptr);
        vkDestroySemaphore(gpu_.device, image.drawn, nullptr);
    }
    images_.clear();
    VkSurfaceCapabilitiesKHR surface;
    check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(gpu_.physical, gpu_.surface, &surface));
    int width = 0, height = 0;
    SDL_Vulkan_GetDrawableSize(window_, &width, &height);
    extent_ = {std::clamp(uint32_t(width), surface.minImageExtent.width, surface.maxImageExtent.width),
               std::clamp(uint32_t(height), surface.minImageExtent.height, surface.maxImageExtent.height)};
    if (extent_.width == 0 || extent_.height == 0)
        return;
    const VkSwapchainKHR old = swapchain_;
    const VkSwapchainCreateInfoKHR info{
        .sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
        .surface = gpu_.surface,
        .minImageCount = surface.maxImageCount == 0
                             ? surface.minImageCount + 1
                             : std::min(surface.minImageCount + 1, surface.maxImageCount),
        .imageFormat = format_.format,
        .imageColorSpace = format_.colorSpace,
        .imageExtent = extent_,
        .imageArrayLayers = 1,
        .imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
        .preTransform = surface.currentTransform,
        .compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR,
        .presentMode = VK_PRESENT_MODE_FIFO_KHR,
        .clipped = VK_TRUE,
        .oldSwapchain = old};
    check(vkCreateSwapchainKHR(gpu_.device, &info, nullptr, &swapchain_));
    vkDestroySwapchainKHR(gpu_.device, old, nullptr);
    uint32_t count = 0;
    vkGetSwapchainImagesKHR(gpu_.device, swapchain_, &count, nullptr);
    std::vector<VkImage> images(count);
    check(vkGetSwapchainImagesKHR(gpu_.device, swapchain_, &count, images.data()));
    for (const VkImage image : images)
    {
        VkImageView view = VK_NULL_HANDLE;
        const VkImageViewCreateInfo view_info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                              .image = image,
                                              .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                              .format = format_.format,
                                              .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
        check(vkCreateImageView(gpu_.device, &view_info, nullptr, &view));
        const VkFramebufferCreateInfo framebuffer{.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                                  .renderPass = pass_,
                                                  .attachmentCount = 1,
                                                  .pAttachments = &view,
                                                  .width = extent_.width,
                                                  .height = extent_.height,
                                                  .layers = 1};
        const VkSemaphoreCreateInfo semaphore{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
        Image& made = images_.emplace_back(Image{image, VK_NULL_HANDLE, VK_NULL_HANDLE});
        check(vkCreateFramebuffer(gpu_.device, &framebuffer, nullptr, &made.framebuffer));
        check(vkCreateSemaphore(gpu_.device, &semaphore, nullptr, &made.drawn));
    }
}

std::optional<uint32_t> Screen::acquire()
{
    uint32_t index = 0;
    const VkSemaphore available = available_[(gpu_.serial() + 1) % kFramesInFlight];
    const VkResult result = images_.empty() ? VK_ERROR_OUT_OF_DATE_KHR
                                            : vkAcquireNextImageKHR(gpu_.device, swapchain_, UINT64_MAX,
                                                                    available, VK_NULL_HANDLE, &index);
    if (result == VK_ERROR_OUT_OF_DATE_KHR)
    {
        createSwapchain();
        return std::nullopt;
    }
    check(result);
    return index;
}

void Screen::record(VkCommandBuffer commands, uint32_t index, VkImage picture, VkExtent2D size)
{
    VkImageMemoryBarrier barrier{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                                 .dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                 .newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                 .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                 .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                 .image = images_[index].image,
                                 .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0,
                         nullptr, 0, nullptr, 1, &barrier);
    const auto corner = [](VkExtent2D extent) {
        return VkOffset3D{int32_t(extent.width), int32_t(extent.height), 1};
    };
    const VkImageSubresourceLayers layer{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    const VkImageBlit blit{layer, {{}, corner(size)}, layer, {{}, corner(extent_)}};
    vkCmdBlitImage(commands, picture, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, barrier.image,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_LINEAR);
    const VkRenderPassBeginInfo begin{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                      .renderPass = pass_,
                                      .framebuffer = images_[index].framebuffer,
                                      .renderArea = {{0, 0}, extent_}};
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
    vkCmdEndRenderPass(commands);
}

void Screen::show(uint32_t index)
{
    gpu_.submit(available_[gpu_.slot()], images_[index].drawn);
    const VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                .waitSemaphoreCount = 1,
                                .pWaitSemaphores = &images_[index].drawn,
                                .swapchainCount = 1,
                                .pSwapchains = &swapchain_,
                                .pImageIndices = &index};
    const VkResult result = vkQueuePresentKHR(gpu_.queue, &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR)
        createSwapchain();
    else
        check(result);
}

} // namespace game
