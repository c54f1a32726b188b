// Dear ImGui on the window: takes events, draws over the picture.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/window/fly_controls.h"
#include "runtime/viewer/window/sdl_window.h"
#include "runtime/viewer/window/swapchain.h"

namespace hearth::viewer
{

/// One at a time in a process, since Dear ImGui has globals.
class ImguiLayer
{
public:
    /// The arguments outlive it. errors: device_failed.
    static Result<std::unique_ptr<ImguiLayer>> create(const SdlWindow& window, VulkanHost& host,
                                                      const gpu::Device& device, const Swapchain& swapchain);
    /// No frame is under way.
    ~ImguiLayer();

    void handle(const SDL_Event& event);
    /// What the panel wants of the keys and the mouse, as far as the last frame tells.
    FlyControls::Kept kept() const;

    /// Between these two the panel is built.
    void beginFrame();
    void endFrame();

    /// Draw what endFrame left over an image of the window: Swapchain::overlayPass.
    void record(VkCommandBuffer commands, const Swapchain& swapchain, uint32_t image) const;

private:
    explicit ImguiLayer(const gpu::Device& device) : device_(device) {}
    Status uploadFonts(VulkanHost& host);

    const gpu::Device& device_;
    gpu::UniqueDescriptorPool descriptors_;
    bool on_window_ = false; ///< its halves, as far as they have begun
    bool on_device_ = false;
};

} // namespace hearth::viewer
