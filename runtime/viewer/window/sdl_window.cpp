// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/sdl_window.h"

#include <SDL.h>
#include <SDL_vulkan.h>
#include <cstdlib>
#include <fcntl.h>
#include <string_view>
#include <unistd.h>

namespace hearth::viewer
{

namespace
{

Error windowError(const char* what)
{
    return {Issue::device, "", "", std::string("cannot ") + what + ": " + SDL_GetError()};
}

/// Redirects stderr to /dev/null while it lives.
class SilentStderr
{
public:
    SilentStderr() : stderr_(::dup(STDERR_FILENO))
    {
        const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
        if (stderr_ >= 0 && nowhere >= 0)
            ::dup2(nowhere, STDERR_FILENO);
        ::close(nowhere);
    }
    SilentStderr(const SilentStderr&) = delete;
    SilentStderr& operator=(const SilentStderr&) = delete;
    ~SilentStderr()
    {
        if (stderr_ >= 0)
            ::dup2(stderr_, STDERR_FILENO);
        ::close(stderr_);
    }

private:
    int stderr_;
};

/// Format the display variables of the environment: "DISPLAY=:0".
std::string namedDisplays()
{
    std::string list;
    for (const char* name : {"WAYLAND_DISPLAY", "DISPLAY"})
        if (const char* value = std::getenv(name); value != nullptr && *value != '\0')
            list += (list.empty() ? "" : ", ") + std::string(name) + "=" + value;
    return list;
}

Error noDisplay(const std::string& reason)
{
    const std::string named = namedDisplays();
    return {Issue::no_display, "", "",
            (named.empty() ? "there is no display: neither DISPLAY nor WAYLAND_DISPLAY is set"
                           : "there is no display at " + named) +
                " (SDL: " + reason + ")"};
}

/// Start SDL on a display. errors: no_display.
Status openDisplay()
{
    {
        // libraries of each display that SDL tries write to stderr; the error of SDL is enough
        const SilentStderr silent;
        if (SDL_Init(SDL_INIT_VIDEO) != 0)
            return noDisplay(SDL_GetError());
    }
    // SDL falls back to these drivers, which show nothing
    const std::string_view driver = SDL_GetCurrentVideoDriver();
    if (driver == "offscreen" || driver == "dummy")
        return noDisplay("video driver " + std::string(driver));
    return success();
}

} // namespace

Result<std::unique_ptr<SdlWindow>> SdlWindow::create(const std::string& title, uint32_t width,
                                                     uint32_t height)
{
    std::unique_ptr<SdlWindow> window(new SdlWindow);
    HEARTH_TRY(openDisplay());
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
