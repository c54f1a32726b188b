// Dear ImGui layer of the window: takes events, draws over the frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/window/fly_controls.h"
#include "runtime/viewer/window/sdl_window.h"
#include "runtime/viewer/window/swapchain.h"

namespace hearth::viewer
{

/// One at a time per process, since Dear ImGui has globals.
class ImguiLayer
{
public:
    /// The arguments outlive the layer. errors: device_failed.
    static Result<std::unique_ptr<ImguiLayer>> create(const SdlWindow& window, VulkanHost& host,
                                                      const gpu::Device& device, const Swapchain& swapchain);
    /// No frame is in flight.
    ~ImguiLayer();

    void handle(const SDL_Event& event);
    /// Return the keys and mouse events that the panel captures, as of the last frame.
    FlyControls::CapturedInput capturedInput() const;

    /// Build the panel between beginFrame and endFrame.
    void beginFrame();
    void endFrame();

    /// Draw the result of endFrame over an image of the window: Swapchain::overlayPass.
    void record(VkCommandBuffer commands, const Swapchain& swapchain, uint32_t image) const;

private:
    explicit ImguiLayer(const gpu::Device& device) : device_(device) {}
    Status uploadFonts(VulkanHost& host);

    const gpu::Device& device_;
    gpu::UniqueDescriptorPool descriptors_;
    bool on_window_ = false; ///< true once the window backend is initialized; on_device_: the Vulkan backend
    bool on_device_ = false;
};

} // namespace hearth::viewer
