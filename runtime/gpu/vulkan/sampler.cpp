// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/sampler.h"

namespace hearth::gpu
{

namespace
{

VkSamplerCreateInfo describeClamping(VkFilter filter)
{
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = filter;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    return info;
}

Result<UniqueSampler> createSampler(const Device& device, const VkSamplerCreateInfo& info)
{
    VkSampler sampler;
    HEARTH_TRY_VK(device.vk.vkCreateSampler(device.handle, &info, device.allocator, &sampler),
                  "create a sampler");
    return UniqueSampler(device, sampler);
}

} // namespace

Result<UniqueSampler> createClampingSampler(const Device& device, VkFilter filter)
{
    return createSampler(device, describeClamping(filter));
}

Result<UniqueSampler> createCubeSampler(const Device& device)
{
    VkSamplerCreateInfo info = describeClamping(VK_FILTER_LINEAR);
    info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    info.maxLod = VK_LOD_CLAMP_NONE;
    return createSampler(device, info);
}

} // namespace hearth::gpu
