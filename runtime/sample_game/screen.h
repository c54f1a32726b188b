// Window of the game: its swapchain, onto which frames are copied, and the menu in front of them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "gpu.h"

#include <optional>
#include <vector>

namespace game
{

class Screen
{
public:
    /// gpu  made for the window
    Screen(Gpu& gpu, SDL_Window* window);
    /// Return the image to draw to; nothing while the window has no size, or has just got another one.
    std::optional<uint32_t> acquire();
    /// Record a copy of a picture, which is in TRANSFER_SRC_OPTIMAL, and the menu of ImGui on it.
    void record(VkCommandBuffer commands, uint32_t index, VkImage picture, VkExtent2D size);
    /// Submit the commands of the frame, and show its image.
    void show(uint32_t index);

private:
    struct Image
    {
        VkImage image;
        VkFramebuffer framebuffer;
        VkSemaphore drawn;
    };
    void createPass();
    void createSwapchain();

    Gpu& gpu_;
    SDL_Window* window_;
    VkSurfaceFormatKHR format_{};
    VkRenderPass pass_ = VK_NULL_HANDLE;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    std::vector<Image> images_;
    std::array<VkSemaphore, kFramesInFlight> available_{};
};

} // namespace game
