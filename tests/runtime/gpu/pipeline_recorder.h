// Records the pipelines that a renderer creates, with their shaders, layouts and specialization constants.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/device.h"

#include <map>
#include <vector>

namespace hearth::test
{

struct RecordedStage
{
    VkShaderStageFlagBits stage;
    std::vector<uint32_t> words;          ///< SPIR-V
    std::map<uint32_t, size_t> constants; ///< bytes of the value, by id
};

using RecordedSet = std::vector<VkDescriptorSetLayoutBinding>;

struct RecordedPipeline
{
    std::vector<RecordedStage> stages;
    std::vector<RecordedSet> sets;
    std::vector<VkPushConstantRange> push;
};

/// Forget all records. Return the description with entry points that record; call it for one renderer at a
/// time. The driver gets neither the pipelines nor the writes to descriptor sets, because it may crash where
/// a shader and a layout differ: such a renderer can upload scenes, but not draw.
gpu::DeviceDescription recordPipelines(const gpu::DeviceDescription& description);

const std::vector<RecordedPipeline>& recordedPipelines();

} // namespace hearth::test
