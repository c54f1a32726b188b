// Commands that copy a frame to an image of the window.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/viewer/window/swapchain.h"

namespace hearth::viewer
{

/// Copy a frame of the window's size to an image of the window, whose old content is lost. Leaves the image
/// in TRANSFER_DST_OPTIMAL. Waits for the image in the transfer stage.
void recordImage(const gpu::Device& device, const WindowTable& vk, VkCommandBuffer commands,
                 const gpu::FrameTargets& targets, VkImage window);

/// Transition from TRANSFER_DST_OPTIMAL after a transfer to TRANSFER_SRC_OPTIMAL, as Swapchain::overlayPass
/// does.
void recordWithoutOverlay(const gpu::Device& device, VkCommandBuffer commands, VkImage window);

/// Copy an image in TRANSFER_SRC_OPTIMAL to host-visible memory.
void recordReadback(const gpu::Device& device, const WindowTable& vk, VkCommandBuffer commands,
                    VkImage window, VkExtent2D extent, const gpu::Buffer& target);

/// Transition from TRANSFER_SRC_OPTIMAL to the present layout.
void recordPresentable(const gpu::Device& device, VkCommandBuffer commands, VkImage window);

} // namespace hearth::viewer
