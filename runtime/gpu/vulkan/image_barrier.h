// Layout transitions of colour images.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/memory.h"

namespace hearth::gpu
{

/// Transition all mips and layers of an image. The writes `written` of `from_stage` are visible to the
/// reads `read` of `to_stage`.
void transition(const Device& device, VkCommandBuffer commands, const Image& image, VkImageLayout from,
                VkImageLayout to, VkAccessFlags written, VkAccessFlags read, VkPipelineStageFlags from_stage,
                VkPipelineStageFlags to_stage);

} // namespace hearth::gpu
