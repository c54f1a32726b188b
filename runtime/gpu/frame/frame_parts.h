// Parts of a frame that can be recorded one by one, and the image states a caller needs to put work between
// them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/device_table.h"

namespace hearth::gpu
{

/// Parts of a frame, in recording order. They synchronize with each other: on one queue no barrier is needed
/// between them, in one command buffer or in several.
enum class FramePart
{
    cull,       ///< Renderer::recordCull
    visibility, ///< Renderer::recordVisibility
    materials,  ///< Renderer::recordMaterials
};

/// Layout, stages and accesses of an image, as a barrier names them.
struct ImageState
{
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkPipelineStageFlags stages = 0;
    VkAccessFlags access = 0;
};

/// Image states before and after a part, for the images of FrameTargets. Stages 0: the part does not touch
/// the image.
struct ImageUse
{
    /// The part waits for such uses by itself; other uses need a barrier of the caller. Layout UNDEFINED: the
    /// content is lost.
    ImageState before;
    /// Visible to these accesses; others need a barrier of the caller. Layout UNDEFINED: the content is lost.
    ImageState after;
};

struct PartImages
{
    ImageUse visibility, color;
};

/// Return the image states of a part, from the table of the frame: the same for all scenes and settings.
/// keeps_visibility  as TargetOptions
PartImages partImages(FramePart part, bool keeps_visibility);

} // namespace hearth::gpu
