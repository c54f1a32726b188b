// Makes the table of a frame: lists its steps, joins neighbouring draws into render passes, and derives what
// has to be loaded, stored and waited for from who uses what.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/frame/frame_description.h"

namespace hearth::gpu
{

/// Describe a frame. An attachment is stored only if a later pass or the caller needs it, and loaded only if
/// an earlier pass of the frame has stored it.
FrameDescription describeFrame(const FrameConfiguration& configuration);
/// Describe frames that have the way and the material test of the first, and keep the depth as it does.
std::vector<FrameDescription> describeFrames(std::span<const FrameConfiguration> configurations);

/// Configurations without a final pass: the first of allConfigurations.
inline constexpr uint32_t kConfigurationCount = 96;

/// Final passes that a frame may have: none; with and without automatic exposure and bloom.
inline constexpr uint32_t kFinalPassCount = 5;

/// Frames that a renderer can draw; each value adds to the one before.
enum class FrameFeatures : uint8_t
{
    shaded,   ///< shading finishes the image
    finished, ///< final passes as well: kFinalPassCount times as many configurations
    deferred, ///< every LightPath as well
};

/// Return all configurations of a way with a material test; scenes have neither shadows nor bricks.
std::vector<FrameConfiguration> allConfigurations(FrameWay way, MaterialTest materials,
                                                  FrameFeatures features = FrameFeatures::shaded);
/// Position in the list of all configurations, whatever the scene has: frames that list lights for visible
/// pixels have the position of frames in parts.
uint32_t configurationIndex(const FrameConfiguration& configuration);

/// Uses of an image by the caller that a frame waits for.
inline constexpr VkPipelineStageFlags kCallerStages =
    VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
/// Uses of the depth by the caller that a frame waits for: its own passes test it, sample it and may write
/// it.
inline constexpr VkPipelineStageFlags kCallerDepthStages =
    kCallerStages | VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT |
    VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
inline constexpr VkAccessFlags kCallerDepthAccess = VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_SHADER_READ_BIT |
                                                    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                                                    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
inline constexpr VkAccessFlags kCallerReads = VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_SHADER_READ_BIT;

/// Return the first pass that has a step, or null.
const Pass* findPass(const FrameDescription& frame, FrameStep step);

/// Add shadow maps of all kinds, in more than one round of culling: passes of further ones are the same.
void addMapsOfAllKinds(FrameConfiguration& configuration);

/// Add each step that lists lights and that a frame with these passes may have. Lists of what pixels show
/// need the passes of a frame in parts.
void addLightLists(FrameConfiguration& configuration);

} // namespace hearth::gpu
