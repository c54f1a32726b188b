// Descriptor and compiled shaders by which shading reads the visibility buffer, for each way through a frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/frame/frame_description.h"
#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

constexpr VkDescriptorType visibilityDescriptor(FrameWay way)
{
    return way == FrameWay::merged ? VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT
                                   : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
}

constexpr shaders::Variant shaderVariant(FrameWay way)
{
    return way == FrameWay::merged ? shaders::kReadsInput : shaders::kReadsSampled;
}

} // namespace hearth::gpu
