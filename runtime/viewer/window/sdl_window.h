// A window that Vulkan can draw to. SDL ends here, in fly_controls.cpp, panel.cpp and viewer.cpp.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/vulkan_host.h"

struct SDL_Window;

namespace hearth::viewer
{

/// One at a time in a process: SDL starts and ends with it.
class SdlWindow
{
public:
    /// width, height  of what is drawn into, in units of the desktop (pixels, but for scaled ones)
    /// errors: no_display; device, where there is no Vulkan.
    static Result<std::unique_ptr<SdlWindow>> create(const std::string& title, uint32_t width,
                                                     uint32_t height);
    ~SdlWindow();

    /// Refers to this window.
    HostWindow hostWindow() const;
    VkExtent2D extent() const; ///< pixels
    SDL_Window* handle() const { return window_; }

private:
    SdlWindow() = default;

    SDL_Window* window_ = nullptr;
};

} // namespace hearth::viewer
