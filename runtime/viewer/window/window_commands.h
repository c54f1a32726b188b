// Commands that follow a frame in an image of the window.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/window/swapchain.h"

namespace hearth::viewer
{

/// Copy an image that a frame has left (kDrawnImage) to host-visible memory. Leaves it in the same state.
void recordReadback(const gpu::Device& device, const WindowTable& vk, VkCommandBuffer commands,
                    VkImage window, VkExtent2D extent, const gpu::Buffer& target);

/// Transition from kDrawnImage to the present layout, as Swapchain::overlayPass does.
void recordPresentable(const gpu::Device& device, VkCommandBuffer commands, VkImage window);

} // namespace hearth::viewer
