// Bits of the lights that may reach a pixel, which a pass ahead of shading has set.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/light_bits.h"
#include "runtime/shaders/shade/light_inputs.glsl"

layout(input_attachment_index = kFirstLightInput, set = kSetAttachments, binding = kAttachmentLight)
    uniform subpassInput low_light_bits;
layout(input_attachment_index = kFirstLightInput + 1u, set = kSetAttachments, binding = kAttachmentLight + 1u)
    uniform subpassInput high_light_bits;

uvec2 loadLightBits()
{
    return uvec2(packUnorm4x8(subpassLoad(low_light_bits)), packUnorm4x8(subpassLoad(high_light_bits)));
}
