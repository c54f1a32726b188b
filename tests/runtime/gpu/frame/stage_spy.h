// Watches the commands of a renderer and follows what waits for what: stages whose work waits, over any
// number of barriers, for the fragments of the passes that a test marks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/device.h"

#include <string>
#include <vector>

namespace hearth::test
{

/// A draw, a dispatch or a transfer.
struct SpiedCommand
{
    std::string label; ///< of the pass that it belongs to
    VkPipelineStageFlags stages = 0;
    VkPipelineStageFlags waiting = 0; ///< of `stages`, those that wait for marked fragments
};

/// Return a description whose renderer is watched, with labels of its passes. One renderer at a time.
gpu::DeviceDescription spyOnStages(const gpu::DeviceDescription& description);

/// Forget all commands and marks.
void forgetCommands();

/// Mark the fragments of further commands in passes of this label; "": of none.
void markFragments(const std::string& label);

/// Take a barrier or a command of the caller.
void addBarrier(VkPipelineStageFlags from, VkPipelineStageFlags to);
void addCommand(VkPipelineStageFlags stages);

/// Return the commands since forgetCommands.
const std::vector<SpiedCommand>& spiedCommands();

} // namespace hearth::test
