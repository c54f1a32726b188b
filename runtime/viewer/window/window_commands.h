// The commands that bring a picture to an image of the window.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/viewer/window/swapchain.h"

namespace hearth::viewer
{

/// Copy the picture of a frame, of the window's size, to an image of the window, whatever was there. Leaves that in
/// TRANSFER_DST_OPTIMAL. Waits for the image in the transfer stage.
void recordPicture(const gpu::Device& device, const WindowTable& vk, VkCommandBuffer commands,
                   const gpu::FrameTargets& targets, VkImage window);

/// From TRANSFER_DST_OPTIMAL behind a transfer to TRANSFER_SRC_OPTIMAL, as Swapchain::overlayPass does.
void recordWithoutOverlay(const gpu::Device& device, VkCommandBuffer commands, VkImage window);

/// Copy an image in TRANSFER_SRC_OPTIMAL to memory that the host reads.
void recordReadback(const gpu::Device& device, const WindowTable& vk, VkCommandBuffer commands,
                    VkImage window, VkExtent2D extent, const gpu::Buffer& target);

/// From TRANSFER_SRC_OPTIMAL to what can be presented.
void recordPresentable(const gpu::Device& device, VkCommandBuffer commands, VkImage window);

} // namespace hearth::viewer
