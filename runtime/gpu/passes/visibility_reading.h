// Descriptors and compiled shaders by which shading reads the visibility buffer, for each way through a
// frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/frame/frame_description.h"
#include "runtime/gpu/scene/draw_layouts.h"
#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

constexpr ShadingDescriptors shadingDescriptors(FrameWay way, bool has_light_images)
{
    return {.visibility = hasSubpasses(way) ? VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT
                                            : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
            .one_set = way == FrameWay::one_set,
            .has_light_images = has_light_images};
}

constexpr shaders::Variant shaderVariant(FrameWay way)
{
    return hasSubpasses(way) ? shaders::kReadsInput : shaders::kReadsSampled;
}

} // namespace hearth::gpu
