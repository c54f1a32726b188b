// Debug labels of passes for debuggers and profilers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/device.h"

namespace hearth::gpu
{

/// Scoped label of recorded commands. Does nothing unless the caller asked for it
/// (DeviceDescription::debug_labels).
class DebugLabel
{
public:
    DebugLabel(const Device& device, VkCommandBuffer commands, const char* name)
        : device_(device), commands_(commands)
    {
        if (device.vk.vkCmdBeginDebugUtilsLabelEXT == nullptr)
            return;
        const VkDebugUtilsLabelEXT label{
            VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, nullptr, name, {0, 0, 0, 0}};
        device.vk.vkCmdBeginDebugUtilsLabelEXT(commands, &label);
    }
    ~DebugLabel()
    {
        if (device_.vk.vkCmdEndDebugUtilsLabelEXT != nullptr)
            device_.vk.vkCmdEndDebugUtilsLabelEXT(commands_);
    }
    DebugLabel(const DebugLabel&) = delete;
    DebugLabel& operator=(const DebugLabel&) = delete;

private:
    const Device& device_;
    VkCommandBuffer commands_;
};

} // namespace hearth::gpu
