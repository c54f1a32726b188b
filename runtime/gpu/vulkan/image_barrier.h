// Moves a colour image from one layout to another.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/memory.h"

namespace hearth::gpu
{

/// All mips of an image without layers. What `from_stage` has `written` is there for `to_stage` to `read`.
void transition(const Device& device, VkCommandBuffer commands, const Image& image, VkImageLayout from,
                VkImageLayout to, VkAccessFlags written, VkAccessFlags read, VkPipelineStageFlags from_stage,
                VkPipelineStageFlags to_stage);

} // namespace hearth::gpu
