// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/sampler.h"

namespace hearth::gpu
{

Result<UniqueSampler> createClampingSampler(const Device& device, VkFilter filter)
{
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = filter;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler sampler;
    HEARTH_TRY_VK(device.vk.vkCreateSampler(device.handle, &info, device.allocator, &sampler),
                  "create a sampler");
    return UniqueSampler(device, sampler);
}

} // namespace hearth::gpu
