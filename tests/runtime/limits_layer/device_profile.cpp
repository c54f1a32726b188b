// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/limits_layer/device_profile.h"

#include "cook/json/json.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <span>

namespace hearth::test
{

namespace
{

/// Members of VkPhysicalDeviceFeatures, in their order.
constexpr const char* kFeatures[] = {
    "robustBufferAccess",
    "fullDrawIndexUint32",
    "imageCubeArray",
    "independentBlend",
    "geometryShader",
    "tessellationShader",
    "sampleRateShading",
    "dualSrcBlend",
    "logicOp",
    "multiDrawIndirect",
    "drawIndirectFirstInstance",
    "depthClamp",
    "depthBiasClamp",
    "fillModeNonSolid",
    "depthBounds",
    "wideLines",
    "largePoints",
    "alphaToOne",
    "multiViewport",
    "samplerAnisotropy",
    "textureCompressionETC2",
    "textureCompressionASTC_LDR",
    "textureCompressionBC",
    "occlusionQueryPrecise",
    "pipelineStatisticsQuery",
    "vertexPipelineStoresAndAtomics",
    "fragmentStoresAndAtomics",
    "shaderTessellationAndGeometryPointSize",
    "shaderImageGatherExtended",
    "shaderStorageImageExtendedFormats",
    "shaderStorageImageMultisample",
    "shaderStorageImageReadWithoutFormat",
    "shaderStorageImageWriteWithoutFormat",
    "shaderUniformBufferArrayDynamicIndexing",
    "shaderSampledImageArrayDynamicIndexing",
    "shaderStorageBufferArrayDynamicIndexing",
    "shaderStorageImageArrayDynamicIndexing",
    "shaderClipDistance",
    "shaderCullDistance",
    "shaderFloat64",
    "shaderInt64",
    "shaderInt16",
    "shaderResourceResidency",
    "shaderResourceMinLod",
    "sparseBinding",
    "sparseResidencyBuffer",
    "sparseResidencyImage2D",
    "sparseResidencyImage3D",
    "sparseResidency2Samples",
    "sparseResidency4Samples",
    "sparseResidency8Samples",
    "sparseResidency16Samples",
    "sparseResidencyAliased",
    "variableMultisampleRate",
    "inheritedQueries",
};
static_assert(sizeof(VkPhysicalDeviceFeatures) == std::size(kFeatures) * sizeof(VkBool32));

[[noreturn]] void stop(const std::string& message)
{
    std::fprintf(stderr, "VK_LAYER_HEARTH_limits: %s\n", message.c_str());
    std::abort();
}

std::span<VkBool32> toSpan(VkPhysicalDeviceFeatures& features)
{
    return {reinterpret_cast<VkBool32*>(&features), std::size(kFeatures)};
}

/// Lower a limit, or raise a minimum, to the values of a profile.
bool clampLimit(const LimitValue& limit, VkPhysicalDeviceLimits& limits)
{
    using Member = uint32_t VkPhysicalDeviceLimits::*;
    using Dimensions = uint32_t(VkPhysicalDeviceLimits::*)[3];
    using Alignment = VkDeviceSize VkPhysicalDeviceLimits::*;
#define HEARTH_LIMIT(name)                                                                                   \
    {                                                                                                        \
        #name, &VkPhysicalDeviceLimits::name                                                                 \
    }
    static const std::map<std::string, Member> kMaxima = {
        HEARTH_LIMIT(maxImageDimension1D),
        HEARTH_LIMIT(maxImageDimension2D),
        HEARTH_LIMIT(maxImageDimension3D),
        HEARTH_LIMIT(maxImageDimensionCube),
        HEARTH_LIMIT(maxImageArrayLayers),
        HEARTH_LIMIT(maxUniformBufferRange),
        HEARTH_LIMIT(maxStorageBufferRange),
        HEARTH_LIMIT(maxPushConstantsSize),
        HEARTH_LIMIT(maxBoundDescriptorSets),
        HEARTH_LIMIT(maxPerStageDescriptorSamplers),
        HEARTH_LIMIT(maxPerStageDescriptorUniformBuffers),
        HEARTH_LIMIT(maxPerStageDescriptorStorageBuffers),
        HEARTH_LIMIT(maxPerStageDescriptorSampledImages),
        HEARTH_LIMIT(maxPerStageDescriptorStorageImages),
        HEARTH_LIMIT(maxPerStageDescriptorInputAttachments),
        HEARTH_LIMIT(maxPerStageResources),
        HEARTH_LIMIT(maxDescriptorSetSamplers),
        HEARTH_LIMIT(maxDescriptorSetUniformBuffers),
        HEARTH_LIMIT(maxDescriptorSetStorageBuffers),
        HEARTH_LIMIT(maxDescriptorSetSampledImages),
        HEARTH_LIMIT(maxDescriptorSetStorageImages),
        HEARTH_LIMIT(maxDescriptorSetInputAttachments),
        HEARTH_LIMIT(maxComputeSharedMemorySize),
        HEARTH_LIMIT(maxComputeWorkGroupInvocations),
        HEARTH_LIMIT(maxFramebufferWidth),
        HEARTH_LIMIT(maxFramebufferHeight),
    };
    static const std::map<std::string, Dimensions> kDimensions = {HEARTH_LIMIT(maxComputeWorkGroupCount),
                                                                  HEARTH_LIMIT(maxComputeWorkGroupSize)};
    static const std::map<std::string, Alignment> kAlignments = {
        HEARTH_LIMIT(minUniformBufferOffsetAlignment), HEARTH_LIMIT(minStorageBufferOffsetAlignment)};
#undef HEARTH_LIMIT
    const auto lower = [](uint32_t& value, uint64_t most)
    { value = static_cast<uint32_t>(std::min<uint64_t>(value, most)); };
    if (const auto found = kMaxima.find(limit.name); found != kMaxima.end() && limit.values.size() == 1)
        lower(limits.*found->second, limit.values[0]);
    else if (const auto array = kDimensions.find(limit.name);
             array != kDimensions.end() && limit.values.size() == 3)
        for (size_t i = 0; i < 3; ++i)
            lower((limits.*array->second)[i], limit.values[i]);
    else if (const auto least = kAlignments.find(limit.name);
             least != kAlignments.end() && limit.values.size() == 1)
        limits.*least->second = std::max(limits.*least->second, VkDeviceSize{limit.values[0]});
    else if (limit.name == "maxSamplerAnisotropy" && limit.values.size() == 1)
        limits.maxSamplerAnisotropy =
            std::min(limits.maxSamplerAnisotropy, static_cast<float>(limit.values[0]));
    else
        return false;
    return true;
}

std::set<VkFormat> parseFormats(const Json& names)
{
    static const std::map<std::string, VkFormat> kFormats = {
        {"D16_UNORM", VK_FORMAT_D16_UNORM},
        {"D32_SFLOAT", VK_FORMAT_D32_SFLOAT},
        {"D32_SFLOAT_S8_UINT", VK_FORMAT_D32_SFLOAT_S8_UINT},
        {"R16G16B16A16_UNORM", VK_FORMAT_R16G16B16A16_UNORM}};
    std::set<VkFormat> formats;
    for (const std::string& name : names.get<std::vector<std::string>>())
    {
        const auto found = kFormats.find(name);
        if (found == kFormats.end())
            stop("unknown format " + name);
        formats.insert(found->second);
    }
    return formats;
}

DeviceProfile parseProfile(const Json& json)
{
    DeviceProfile profile;
    for (const Json::Member& member : json.at("limits").items())
    {
        LimitValue limit{member.key, {}};
        if (member.value.is_array())
            limit.values = member.value.get<std::vector<uint64_t>>();
        else
            limit.values = {member.value.get<uint64_t>()};
        if (VkPhysicalDeviceLimits scratch{}; !clampLimit(limit, scratch))
            stop("unknown limit " + limit.name);
        profile.limits.push_back(std::move(limit));
    }
    for (const std::string& feature : json.at("features").get<std::vector<std::string>>())
    {
        if (std::find(std::begin(kFeatures), std::end(kFeatures), feature) == std::end(kFeatures))
            stop("unknown feature " + feature);
        profile.features.insert(feature);
    }
    profile.missing_formats = parseFormats(json.at("missing_formats"));
    if (json.contains("unfiltered_formats"))
        profile.unfiltered_formats = parseFormats(json.at("unfiltered_formats"));
    return profile;
}

} // namespace

DeviceProfile readProfile(const char* path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::optional<Json> json = Json::parse(text);
    if (!json)
        stop(std::string("cannot read ") + path);
    return parseProfile(*json);
}

void clampLimits(const DeviceProfile& profile, VkPhysicalDeviceLimits& limits)
{
    for (const LimitValue& limit : profile.limits)
        clampLimit(limit, limits);
}

void clampFeatures(const DeviceProfile& profile, VkPhysicalDeviceFeatures& features)
{
    const std::span<VkBool32> values = toSpan(features);
    for (size_t i = 0; i < values.size(); ++i)
        if (!profile.features.contains(kFeatures[i]))
            values[i] = VK_FALSE;
}

void clampFormat(const DeviceProfile& profile, VkFormat format, VkFormatProperties& properties)
{
    if (profile.missing_formats.contains(format))
        properties = {};
    if (profile.unfiltered_formats.contains(format))
        for (VkFormatFeatureFlags* features :
             {&properties.linearTilingFeatures, &properties.optimalTilingFeatures})
            *features &= ~VkFormatFeatureFlags{VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT};
}

std::string findMissingFeature(const DeviceProfile& profile, const VkPhysicalDeviceFeatures& enabled)
{
    VkPhysicalDeviceFeatures copy = enabled;
    const std::span<const VkBool32> values = toSpan(copy);
    for (size_t i = 0; i < values.size(); ++i)
        if (values[i] == VK_TRUE && !profile.features.contains(kFeatures[i]))
            return kFeatures[i];
    return {};
}

} // namespace hearth::test
