// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/device_limits.h"

#include <string>

namespace hearth::gpu
{

namespace
{

#define HEARTH_LIMIT(member)                                                                                 \
    #member, [](const VkPhysicalDeviceLimits& limits) -> uint64_t { return limits.member; }

// as low as the shaders and layouts allow: gpu_interface_test compares them
constexpr RequiredLimit kLimits[] = {
    {HEARTH_LIMIT(maxPerStageDescriptorStorageBuffers), 8, "storage buffers in a stage",
     "shading: tables of the scene and four slices of geometry"},
    {HEARTH_LIMIT(maxPerStageDescriptorUniformBuffers), 4, "uniform buffers in a stage",
     "shading: view, shadows, material and its layers"},
    {HEARTH_LIMIT(maxPerStageDescriptorSamplers), 16, "samplers in a stage",
     "shading: nine textures, tables, shadow maps, gathered light, visibility buffer"},
    {HEARTH_LIMIT(maxPerStageDescriptorSampledImages), 16, "sampled images in a stage", "as the samplers"},
    {HEARTH_LIMIT(maxPerStageDescriptorStorageImages), 1, "storage images in a stage", "gathered light"},
    {HEARTH_LIMIT(maxPerStageDescriptorInputAttachments), 4, "input attachments in a stage",
     "shading by sums of light: three, and the visibility buffer"},
    {HEARTH_LIMIT(maxPerStageResources), 32, "resources in a stage",
     "shading: the above and its colour attachment"},
    {HEARTH_LIMIT(maxDescriptorSetStorageBuffers), 9, "storage buffers in a pipeline", "shading by tiles"},
    {HEARTH_LIMIT(maxDescriptorSetUniformBuffers), 4, "uniform buffers in a pipeline", "shading"},
    {HEARTH_LIMIT(maxDescriptorSetSamplers), 16, "samplers in a pipeline", "shading"},
    {HEARTH_LIMIT(maxDescriptorSetSampledImages), 16, "sampled images in a pipeline", "shading"},
    {HEARTH_LIMIT(maxBoundDescriptorSets), 3, "descriptor sets at once", "drawing and shading"},
    {HEARTH_LIMIT(maxPushConstantsSize), 80, "bytes of push constants", "motion vectors"},
    {HEARTH_LIMIT(maxUniformBufferRange), 7184, "bytes in a uniform buffer", "shadow maps of the lights"},
    {HEARTH_LIMIT(maxStorageBufferRange), uint64_t{128} << 20, "bytes in a storage buffer",
     "a slice of geometry"},
    {HEARTH_LIMIT(maxComputeWorkGroupInvocations), 128, "threads in a workgroup",
     "prefix sums, material tiles, depth pyramid"},
    {HEARTH_LIMIT(maxComputeWorkGroupSize[0]), 128, "threads in a row of a workgroup", "prefix sums"},
    {HEARTH_LIMIT(maxComputeWorkGroupSize[1]), 8, "rows in a workgroup", "depth pyramid, gathered light"},
    {HEARTH_LIMIT(maxComputeSharedMemorySize), 3040, "bytes of a workgroup's memory", "gathered light"},
};

#undef HEARTH_LIMIT

constexpr VkFormatFeatureFlags kSampled = VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
constexpr VkFormatFeatureFlags kFiltered = kSampled | VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;

constexpr RequiredFormat kFormats[] = {
    {VK_FORMAT_R32_UINT, kSampled | VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, "R32_UINT", "visibility buffer"},
    {VK_FORMAT_R8G8B8A8_SRGB, kFiltered | VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, "R8G8B8A8_SRGB",
     "shaded frame, textures"},
    {VK_FORMAT_D32_SFLOAT, kSampled | VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT, "D32_SFLOAT",
     "depth, shadow maps"},
    {VK_FORMAT_D16_UNORM, kSampled | VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT, "D16_UNORM",
     "shadow maps with 16-bit depths"},
    {VK_FORMAT_R8G8B8A8_UNORM, kFiltered, "R8G8B8A8_UNORM", "textures"},
    {VK_FORMAT_R8_UNORM, kFiltered, "R8_UNORM", "table of specular occlusion"},
    {VK_FORMAT_R16G16_SFLOAT, kFiltered | VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, "R16G16_SFLOAT",
     "table of the sky, motion vectors"},
    {VK_FORMAT_R16G16B16A16_SFLOAT, kFiltered, "R16G16B16A16_SFLOAT", "table of reflectance, textures"},
    {VK_FORMAT_R32G32B32A32_UINT, kSampled | VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, "R32G32B32A32_UINT",
     "gathered light"},
};

} // namespace

std::span<const RequiredLimit> requiredLimits()
{
    return kLimits;
}

std::span<const RequiredFormat> requiredFormats()
{
    return kFormats;
}

Status checkLimits(const VkPhysicalDeviceProperties& properties)
{
    for (const RequiredLimit& limit : kLimits)
        if (const uint64_t has = limit.read(properties.limits); has < limit.needed)
            return Error{Issue::device, "", "",
                         std::string(properties.deviceName) + " has " + std::to_string(has) + " " +
                             limit.unit + " (" + limit.name + "), " + std::to_string(limit.needed) +
                             " are needed: " + limit.user};
    return success();
}

Status checkFormat(const DeviceTable& vk, VkPhysicalDevice physical_device,
                   const VkPhysicalDeviceProperties& properties, const RequiredFormat& required)
{
    VkFormatProperties format;
    vk.vkGetPhysicalDeviceFormatProperties(physical_device, required.format, &format);
    if ((format.optimalTilingFeatures & required.features) == required.features)
        return success();
    constexpr VkFormatFeatureFlags kDrawn =
        VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT;
    const bool lacks_drawing = (required.features & kDrawn & ~format.optimalTilingFeatures) != 0;
    return Error{Issue::device, "", "",
                 std::string(properties.deviceName) + " cannot " +
                     (lacks_drawing ? "render to " : "sample, filter or write ") + required.name + ": " +
                     required.user};
}

} // namespace hearth::gpu
