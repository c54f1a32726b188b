// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/sdl_window.h"

#include <SDL.h>
#include <SDL_vulkan.h>

namespace hearth::viewer
{

namespace
{

Error windowError(const char* what)
{
    return {Issue::device, "", "", std::string("cannot ") + what + ": " + SDL_GetError()};
}

} // namespace

Result<std::unique_ptr<SdlWindow>> SdlWindow::create(const std::string& title, uint32_t width,
                                                     uint32_t height)
{
    std::unique_ptr<SdlWindow> window(new SdlWindow);
    if (SDL_Init(SDL_INIT_VIDEO) != 0)
        return windowError("open a display");
    window->window_ = SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED,
                                       static_cast<int>(width), static_cast<int>(height),
                                       SDL_WINDOW_VULKAN | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    if (window->window_ == nullptr)
        return windowError("open a window");
    return window;
}

SdlWindow::~SdlWindow()
{
    if (window_ != nullptr)
        SDL_DestroyWindow(window_);
    SDL_Quit();
}

HostWindow SdlWindow::hostWindow() const
{
    HostWindow host;
    unsigned count = 0;
    SDL_Vulkan_GetInstanceExtensions(window_, &count, nullptr);
    host.instance_extensions.resize(count);
    SDL_Vulkan_GetInstanceExtensions(window_, &count, host.instance_extensions.data());
    host.create_surface = [window = window_](VkInstance instance) -> Result<VkSurfaceKHR>
    {
        VkSurfaceKHR surface = VK_NULL_HANDLE;
        if (SDL_Vulkan_CreateSurface(window, instance, &surface) != SDL_TRUE)
            return windowError("draw to the window");
        return surface;
    };
    return host;
}

VkExtent2D SdlWindow::extent() const
{
    int width = 0, height = 0;
    SDL_Vulkan_GetDrawableSize(window_, &width, &height);
    return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

} // namespace hearth::viewer
