// SDL window with a Vulkan surface. SDL is used only here, in fly_controls.cpp, panel.cpp and viewer.cpp.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/vulkan_host.h"

struct SDL_Window;

namespace hearth::viewer
{

/// One at a time per process: SDL starts and ends with it.
class SdlWindow
{
public:
    /// width, height  of the drawable area, in units of the desktop (pixels unless scaled)
    /// errors: no_display; device if there is no Vulkan.
    static Result<std::unique_ptr<SdlWindow>> create(const std::string& title, uint32_t width,
                                                     uint32_t height);
    ~SdlWindow();

    /// The result refers to this window.
    HostWindow hostWindow() const;
    VkExtent2D extent() const; ///< pixels
    SDL_Window* handle() const { return window_; }

private:
    SdlWindow() = default;

    SDL_Window* window_ = nullptr;
};

} // namespace hearth::viewer
