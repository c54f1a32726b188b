// Tests that the renderer works within the limits of other devices, and says what a device lacks. The tests'
// Vulkan layer shows those limits and refuses what exceeds them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/vulkan_host.h"

#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hearth::test
{

namespace
{

using gpu::FrameWay;
using gpu::MaterialTest;

/// Give a variable of the environment a value, or none.
void setVariable(const char* name, const std::optional<std::string>& value)
{
    if (value)
        ::setenv(name, value->c_str(), 1);
    else
        ::unsetenv(name);
}

/// Create a device with the limits of a profile. The environment stays as it was: it may name a profile for
/// the other tests of this process.
std::unique_ptr<viewer::VulkanHost> createHost(const std::string& profile)
{
    const std::pair<const char*, std::string> environment[] = {
        {"VK_ADD_LAYER_PATH", HEARTH_LIMITS_LAYER},
        {"VK_INSTANCE_LAYERS", "VK_LAYER_HEARTH_limits"},
        {"HEARTH_TEST_LIMITS", HEARTH_LIMITS_PROFILES "/" + profile + ".json"}};
    std::vector<std::optional<std::string>> before;
    for (const auto& [name, value] : environment)
    {
        const char* const old = std::getenv(name);
        before.push_back(old != nullptr ? std::optional<std::string>(old) : std::nullopt);
        setVariable(name, value);
    }
    auto host = viewer::VulkanHost::create({.device_name = "", .validate = true});
    for (size_t i = 0; i < before.size(); ++i)
        setVariable(environment[i].first, before[i]);
    HEARTH_ASSERT(host.ok());
    return std::move(*host);
}

/// Create a pipeline layout of a set with so many storage buffers.
VkResult createPipelineLayout(const viewer::VulkanHost& host, uint32_t storage_buffers)
{
    const gpu::DeviceDescription description = host.description();
    gpu::DeviceTable vk;
    HEARTH_ASSERT(vk.load(description.get_instance_proc_addr, description.instance, description.device) ==
                  nullptr);
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (uint32_t i = 0; i < storage_buffers; ++i)
        bindings.push_back({i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    const VkDescriptorSetLayoutCreateInfo set_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                   nullptr, 0, storage_buffers, bindings.data()};
    VkDescriptorSetLayout set;
    HEARTH_ASSERT(vk.vkCreateDescriptorSetLayout(description.device, &set_info, nullptr, &set) == VK_SUCCESS);
    const VkPipelineLayoutCreateInfo info{
        VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, 1, &set, 0, nullptr};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    const VkResult result = vk.vkCreatePipelineLayout(description.device, &info, nullptr, &layout);
    if (result == VK_SUCCESS)
        vk.vkDestroyPipelineLayout(description.device, layout, nullptr);
    vk.vkDestroyDescriptorSetLayout(description.device, set, nullptr);
    return result;
}

} // namespace

TEST(DeviceLimits, thoseOfAndroid15AndOfTileBasedGpusAreEnough)
{
    for (const char* profile : {"android15", "videocore6", "adreno540", "adreno618", "malig52", "malig610"})
    {
        const auto host = createHost(profile);
        for (const FrameWay way : gpu::kFrameWays)
        {
            const auto renderer = gpu::Renderer::create(host->description(), {.way = way});
            EXPECT_TRUE(renderer.ok()) << profile << formatMessage(renderer.error());
        }
        EXPECT_EQ(host->messages(), std::vector<std::string>{});
    }
}

TEST(DeviceLimits, theStencilsFormatIsOnTileBasedGpus)
{
    for (const char* profile : {"android15", "videocore6", "adreno618", "malig52", "malig610"})
    {
        const auto host = createHost(profile);
        for (const FrameWay way : gpu::kFrameWays)
        {
            const auto renderer =
                gpu::Renderer::create(host->description(), {.way = way, .materials = MaterialTest::id});
            EXPECT_TRUE(renderer.ok()) << profile << formatMessage(renderer.error());
        }
        EXPECT_EQ(host->messages(), std::vector<std::string>{});
    }
}

TEST(DeviceLimits, theLayerShowsThem)
{
    const auto host = createHost("android15");
    const auto device = gpu::makeDevice(host->description());
    ASSERT_TRUE(device.ok());
    EXPECT_EQ(device->limits.maxPerStageDescriptorStorageBuffers, 12u);
    EXPECT_EQ(device->limits.maxComputeWorkGroupInvocations, 128u);
    EXPECT_FALSE(device->texel_formats[static_cast<size_t>(formats::TexelFormat::rgba16_unorm)]);
}

TEST(DeviceLimits, theLayerShowsFormatsThatAreNotFiltered)
{
    const auto host = createHost("adreno540");
    const gpu::DeviceDescription description = host->description();
    const auto device = gpu::makeDevice(description);
    ASSERT_TRUE(device.ok());
    const auto features = [&](VkFormat format)
    {
        VkFormatProperties properties;
        device->vk.vkGetPhysicalDeviceFormatProperties(description.physical_device, format, &properties);
        return properties.optimalTilingFeatures;
    };
    for (const VkFormat format : {VK_FORMAT_D16_UNORM, VK_FORMAT_D32_SFLOAT})
    {
        EXPECT_NE(features(format) & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT, 0u);
        EXPECT_EQ(features(format) & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT, 0u);
    }
    EXPECT_FALSE(device->texel_formats[static_cast<size_t>(formats::TexelFormat::rgba16_unorm)]);
    EXPECT_FALSE(gpu::makeDevice(createHost("malig52")->description())
                     ->texel_formats[static_cast<size_t>(formats::TexelFormat::rgba16_unorm)]);
}

TEST(DeviceLimits, theLayerRefusesMore)
{
    const auto host = createHost("videocore6");
    EXPECT_EQ(createPipelineLayout(*host, 12), VK_SUCCESS);
    EXPECT_EQ(createPipelineLayout(*host, 13), VK_ERROR_VALIDATION_FAILED_EXT);
}

TEST(DeviceLimits, theMinimumOfVulkanGetsOneClearError)
{
    const auto host = createHost("minimum");
    const auto renderer = gpu::Renderer::create(host->description());
    ASSERT_FALSE(renderer.ok());
    EXPECT_EQ(renderer.error().issue, Issue::device);
    EXPECT_THAT(renderer.error().detail,
                testing::StartsWith(host->deviceName() +
                                    " has 4 storage buffers in a stage "
                                    "(maxPerStageDescriptorStorageBuffers), 8 are needed: "));
}

TEST(DeviceLimits, theStencilsFormatIsNeededByMaterialsByIdAlone)
{
    for (const char* profile : {"roadmap2022", "adreno540"})
    {
        const auto host = createHost(profile);
        EXPECT_TRUE(gpu::Renderer::create(host->description()).ok());
        const auto renderer = gpu::Renderer::create(host->description(), {.materials = MaterialTest::id});
        ASSERT_FALSE(renderer.ok());
        EXPECT_EQ(renderer.error().issue, Issue::device);
        EXPECT_THAT(renderer.error().detail, testing::HasSubstr("cannot render to D32_SFLOAT_S8_UINT"));
    }
}

} // namespace hearth::test
