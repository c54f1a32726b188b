// Watches the stencil while lights are drawn by their volumes: behind each draw that marks the pixels of a
// volume or takes the marks away, a draw of its own in the same subpass counts the pixels that have a mark.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/device.h"

#include <vector>

namespace hearth::test
{

/// Marks in the stencil around one light, in the order in which lights are drawn.
struct StencilMarks
{
    bool marked = false; ///< some pixel, before the light is added
    bool left = false;   ///< some pixel, behind it
};

/// Return a description whose renderer is watched. One renderer at a time.
gpu::DeviceDescription spyOnStencil(const gpu::DeviceDescription& description);

/// Create what the counts need: room for so many lights a frame. Call it once the renderer is there.
void beginStencilCounts(const gpu::Device& device, uint32_t lights);
void endStencilCounts(const gpu::Device& device);

/// Record before the frame, outside a render pass.
void resetStencilCounts(const gpu::Device& device, VkCommandBuffer commands);

/// Return the marks of the last frame, which has completed.
std::vector<StencilMarks> readStencilCounts(const gpu::Device& device);

} // namespace hearth::test
