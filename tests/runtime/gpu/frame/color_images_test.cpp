// Tests images of the caller that frames show: all formats hold the same picture, each frame draws the image
// that it names, and leaves it in the state that the caller has asked for.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "tests/runtime/gpu/replace_function.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <array>
#include <cmath>

namespace hearth::test
{

namespace
{

constexpr VkExtent2D kSize{64, 48};
/// State in which VulkanHost::readSampled reads an image.
constexpr gpu::ImageState kSampled{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                   VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT};

using Color = std::array<double, 3>;

/// Return the code of a display-linear channel, of `white` for 1 (IEC 61966-2-1).
double encodedTo(double linear, double white)
{
    const double c = std::clamp(linear, 0.0, 1.0);
    return white * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
}

/// Return the display-linear value of a radiance, by the curve of J. Hejl and R. Burgess-Dawson (2010).
double toneMapped(double radiance)
{
    const double x = std::max(0.0, radiance - 0.004);
    return std::pow(x * (6.2 * x + 0.5) / (x * (6.2 * x + 1.7) + 0.06), 2.2);
}

/// Channels of a pixel: red, green and blue of 255, or radiance.
Color readChannels(VkFormat format, const std::byte* texel)
{
    std::array<uint16_t, 4> halves{};
    std::memcpy(halves.data(), texel, format == VK_FORMAT_R16G16B16A16_SFLOAT ? 8 : 4);
    const uint32_t word = halves[0] | uint32_t{halves[1]} << 16;
    const auto bits = [&](uint32_t shift, uint32_t count)
    { return static_cast<double>(word >> shift & ((1u << count) - 1)); };
    const auto ofHalf = [](double code, int shift)
    { return double{floatFromHalf(static_cast<uint16_t>(static_cast<uint32_t>(code) << shift))}; };
    switch (format)
    {
    case VK_FORMAT_B8G8R8A8_SRGB:
    case VK_FORMAT_B8G8R8A8_UNORM:
        return {bits(16, 8), bits(8, 8), bits(0, 8)};
    case VK_FORMAT_A2B10G10R10_UNORM_PACK32:
        return {bits(0, 10) * 255 / 1023, bits(10, 10) * 255 / 1023, bits(20, 10) * 255 / 1023};
    case VK_FORMAT_A2R10G10B10_UNORM_PACK32:
        return {bits(20, 10) * 255 / 1023, bits(10, 10) * 255 / 1023, bits(0, 10) * 255 / 1023};
    case VK_FORMAT_R16G16B16A16_SFLOAT:
        return {double{floatFromHalf(halves[0])}, double{floatFromHalf(halves[1])},
                double{floatFromHalf(halves[2])}};
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32: // halves without sign, and with less bits of fraction
        return {ofHalf(bits(0, 11), 4), ofHalf(bits(11, 11), 4), ofHalf(bits(22, 10), 5)};
    default:
        return {bits(0, 8), bits(8, 8), bits(16, 8)};
    }
}

/// Barriers over all memory that renderers record, and the real functions.
struct BarrierSpy
{
    struct Barrier
    {
        VkPipelineStageFlags from, to;
        VkAccessFlags written, read;
    };
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    PFN_vkGetDeviceProcAddr get_device_proc_addr = nullptr;
    PFN_vkCmdPipelineBarrier pipeline_barrier = nullptr;
    std::vector<Barrier> barriers;
};
BarrierSpy barrier_spy;

VKAPI_ATTR void VKAPI_CALL spyOnBarrier(VkCommandBuffer commands, VkPipelineStageFlags from,
                                        VkPipelineStageFlags to, VkDependencyFlags flags,
                                        uint32_t memory_count, const VkMemoryBarrier* memory,
                                        uint32_t buffer_count, const VkBufferMemoryBarrier* buffers,
                                        uint32_t image_count, const VkImageMemoryBarrier* images)
{
    for (uint32_t i = 0; i < memory_count; ++i)
        barrier_spy.barriers.push_back({from, to, memory[i].srcAccessMask, memory[i].dstAccessMask});
    barrier_spy.pipeline_barrier(commands, from, to, flags, memory_count, memory, buffer_count, buffers,
                                 image_count, images);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getSpiedDeviceProcAddr(VkDevice device, const char* name)
{
    const PFN_vkVoidFunction function = barrier_spy.get_device_proc_addr(device, name);
    return std::string_view(name) == "vkCmdPipelineBarrier"
               ? replaceFunction(function, barrier_spy.pipeline_barrier, spyOnBarrier)
               : function;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getSpiedInstanceProcAddr(VkInstance instance, const char* name)
{
    const PFN_vkVoidFunction function = barrier_spy.get_instance_proc_addr(instance, name);
    return std::string_view(name) == "vkGetDeviceProcAddr"
               ? replaceFunction(function, barrier_spy.get_device_proc_addr, getSpiedDeviceProcAddr)
               : function;
}

/// Settings of a frame.
struct Shown
{
    uint32_t image = 0;
    float eye_x = 0;
    gpu::PostSettings post{};
    uint32_t debug_view = shared::kViewFinal;
    bool in_parts = false;
};

/// Scene on a renderer of a format, and targets that show images of the caller.
struct Stage
{
    std::unique_ptr<gpu::Renderer> renderer;
    std::unique_ptr<gpu::Scene> scene;
    std::unique_ptr<gpu::MemoryArena> arena;
    std::vector<gpu::Image> images; ///< none: that of the targets
    std::optional<gpu::FrameTargets> targets;
};

class ColorImagesTest : public GpuTest
{
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        std::mt19937 random(5);
        formats::MaterialRecord unlit = plainMaterial();
        unlit.flags = formats::kMaterialUnlit;
        unlit.base_color = {0.7f, 0.3f, 0.1f, 1};
        formats::MaterialRecord lamp = plainMaterial();
        lamp.emissive = {3, 1, 0.2f};
        uint32_t seed = 1;
        for (const formats::MaterialRecord& material : {plainMaterial(), unlit, lamp})
            test_.addInstance(
                test_.addMesh(withMaterial(shapes::rock(8, 0.2f, seed++), test_.addMaterial(material))),
                randomAffine(random, 1.2f));
        pack_ = test_.build();
    }

    static bool canDraw(VkFormat format)
    {
        VkFormatProperties properties;
        renderer().device().vk.vkGetPhysicalDeviceFormatProperties(host().description().physical_device,
                                                                   format, &properties);
        return (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT) != 0;
    }

    Stage makeStage(VkFormat format, uint32_t image_count, gpu::TargetOptions options = {},
                    const gpu::ImageState& before = kSampled, const gpu::ImageState& after = kSampled)
    {
        Stage stage;
        gpu::RendererOptions of_test = testRendererOptions();
        of_test.post = gpu::PostSupport::half;
        of_test.color_format = format;
        gpu::DeviceDescription description = host().description();
        barrier_spy = {.get_instance_proc_addr = description.get_instance_proc_addr};
        description.get_instance_proc_addr = getSpiedInstanceProcAddr;
        auto renderer = gpu::Renderer::create(description, of_test);
        HEARTH_ASSERT(renderer.ok());
        stage.renderer = std::move(*renderer);
        run(
            [&](VkCommandBuffer commands)
            {
                auto scene = stage.renderer->upload(*pack_, commands, {});
                HEARTH_ASSERT(scene.ok());
                stage.scene = std::move(*scene);
            });
        stage.scene->staging.reset();
        stage.arena = std::make_unique<gpu::MemoryArena>(stage.renderer->device(), 0);
        options.colors = {.before = before, .after = after};
        for (uint32_t i = 0; i < image_count; ++i)
        {
            auto image = stage.arena->createImage(
                {.format = format,
                 .extent = options.output.width != 0 ? options.output : kSize,
                 .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                          VK_IMAGE_USAGE_SAMPLED_BIT});
            HEARTH_ASSERT(image.ok());
            options.colors.images.push_back(image->handle.get());
            stage.images.push_back(std::move(*image));
        }
        auto targets = stage.renderer->createTargets(kSize, options);
        HEARTH_ASSERT(targets.ok());
        stage.targets = std::move(*targets);
        return stage;
    }

    static void run(const std::function<void(VkCommandBuffer)>& record)
    {
        const Status status = host().run(
            [&](VkCommandBuffer commands)
            {
                record(commands);
                return success();
            });
        HEARTH_ASSERT(status.ok());
    }

    static void drawTo(Stage& stage, const Shown& shown)
    {
        run([&](VkCommandBuffer commands) { record(stage, shown, commands); });
    }

    static void record(Stage& stage, const Shown& shown, VkCommandBuffer commands)
    {
        const shared::Camera camera{
            .position = {shown.eye_x, 0, 4}, .target = {shown.eye_x, 0, 0}, .y_fov_rad = 0.8f};
        const gpu::FrameInput input{
            .view = makeView(*stage.scene, camera, {.width = kSize.width, .height = kSize.height}),
            .shading = {.debug_view = shown.debug_view, .post = shown.post},
            .color_image = shown.image};
        const gpu::Renderer& r = *stage.renderer;
        if (!shown.in_parts)
            return r.record(commands, *stage.scene, *stage.targets, input);
        r.recordCull(commands, *stage.scene, *stage.targets, input);
        r.recordVisibility(commands, *stage.scene, *stage.targets, input);
        r.recordMaterials(commands, *stage.scene, *stage.targets, input);
    }

    static std::vector<Color> read(const Stage& stage, uint32_t number = 0)
    {
        const gpu::ColorFormat& format = stage.renderer->colorFormat();
        const gpu::Device& device = stage.renderer->device();
        const auto bytes = stage.images.empty()
                               ? host().read(device, stage.targets->color(), format.bytes)
                               : host().readSampled(device, stage.images[number], format.bytes);
        HEARTH_ASSERT(bytes.ok());
        std::vector<Color> colors;
        for (size_t at = 0; at < bytes->size(); at += format.bytes)
            colors.push_back(readChannels(format.format, &(*bytes)[at]));
        return colors;
    }

    /// Codes of 255 that a display of radiance would show.
    static std::vector<Color> displayed(std::vector<Color> radiance)
    {
        for (Color& color : radiance)
            for (double& value : color)
                value = encodedTo(toneMapped(value), 255);
        return radiance;
    }

    static double largestStep(const std::vector<Color>& a, const std::vector<Color>& b)
    {
        HEARTH_ASSERT(a.size() == b.size());
        double largest = 0;
        for (size_t i = 0; i < a.size(); ++i)
            for (size_t c = 0; c < 3; ++c)
                largest = std::max(largest, std::abs(a[i][c] - b[i][c]));
        return largest;
    }

    TestScene test_;
    std::optional<formats::PackView> pack_;
};

} // namespace

TEST_F(ColorImagesTest, allFormatsHoldTheSamePicture)
{
    const Shown kinds[] = {
        {},
        {.in_parts = true},
        {.post = {.exposure_stops = 0.5f}},
        {.post = {.exposure_stops = -1, .bloom = {.strength = 0.3f, .mode = gpu::BloomMode::add}}},
        {.debug_view = shared::kViewNormals},
        {.debug_view = shared::kViewCones}};
    Stage usual = makeStage(VK_FORMAT_R8G8B8A8_SRGB, 0, {.may_bloom = true});
    for (const gpu::ColorFormat& format : gpu::colorFormats())
    {
        if (!canDraw(format.format))
            continue;
        Stage stage = makeStage(format.format, 2, {.may_bloom = true});
        for (const Shown& shown : kinds)
        {
            drawTo(usual, shown);
            drawTo(stage, shown);
            const std::vector<Color> expected = read(usual);
            std::vector<Color> colors = read(stage);
            // steps of 255, by which codes and floats of 16 or 11 bits are rounded
            double allowed = 0;
            if (format.content == gpu::ColorContent::codes)
                allowed = 1;
            if (format.content == gpu::ColorContent::radiance)
                allowed = format.bytes == 8 ? 1.1 : 4;
            if (format.content == gpu::ColorContent::radiance && shown.debug_view != shared::kViewFinal)
            {
                for (Color& color : colors)
                    for (double& value : color)
                        value = encodedTo(value, 255);
            }
            else if (format.content == gpu::ColorContent::radiance)
                colors = displayed(colors);
            EXPECT_LE(largestStep(colors, expected), allowed)
                << format.name << ", view " << shown.debug_view << ", bloom " << shown.post.bloom.strength;
        }
    }
}

TEST_F(ColorImagesTest, framesDrawTheImageThatTheyName)
{
    Stage usual = makeStage(VK_FORMAT_R8G8B8A8_SRGB, 0);
    Stage stage = makeStage(VK_FORMAT_R8G8B8A8_SRGB, 3);
    EXPECT_LT(stage.targets->allocatedBytes() + kSize.width * kSize.height * 4,
              usual.targets->allocatedBytes() + 1)
        << "no image of its own";
    std::vector<std::vector<Color>> expected;
    for (const uint32_t image : {0u, 1u, 2u})
    {
        const Shown shown{.image = image, .eye_x = 0.5f * static_cast<float>(image)};
        drawTo(stage, shown);
        drawTo(usual, {.eye_x = shown.eye_x});
        expected.push_back(read(usual));
    }
    for (const uint32_t image : {0u, 1u, 2u})
        EXPECT_EQ(read(stage, image), expected[image]) << image;
    EXPECT_NE(expected[0], expected[1]);
}

TEST_F(ColorImagesTest, framesWaitForTheCallersUsesAndTheseForThem)
{
    // stages that no frame has
    const gpu::ImageState before{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_VERTEX_INPUT_BIT, 0};
    const gpu::ImageState after{kSampled.layout, VK_PIPELINE_STAGE_VERTEX_INPUT_BIT,
                                VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT};
    Stage stage = makeStage(VK_FORMAT_R8G8B8A8_SRGB, 1, {}, before, after);
    drawTo(stage, {});
    constexpr VkPipelineStageFlags kDrawn = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    std::vector<BarrierSpy::Barrier> ahead, behind;
    for (const BarrierSpy::Barrier& barrier : barrier_spy.barriers)
    {
        if ((barrier.from & before.stages) != 0)
            ahead.push_back(barrier);
        if ((barrier.to & after.stages) != 0)
            behind.push_back(barrier);
    }
    ASSERT_FALSE(ahead.empty());
    for (const BarrierSpy::Barrier& barrier : ahead)
        EXPECT_TRUE((barrier.to & kDrawn) != 0);
    ASSERT_EQ(behind.size(), 1u);
    EXPECT_TRUE((behind[0].from & kDrawn) != 0);
    EXPECT_TRUE((behind[0].written & VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT) != 0);
    EXPECT_EQ(behind[0].read, after.access);
}

TEST_F(ColorImagesTest, finalPassesEnlargeIntoThem)
{
    const gpu::TargetOptions larger{.output = {kSize.width * 2, kSize.height + 5}};
    Stage usual = makeStage(VK_FORMAT_R8G8B8A8_SRGB, 0, larger);
    Stage stage = makeStage(VK_FORMAT_R8G8B8A8_SRGB, 2, larger);
    drawTo(usual, {});
    drawTo(stage, {.image = 1});
    EXPECT_EQ(read(stage, 1), read(usual));
}

} // namespace hearth::test
