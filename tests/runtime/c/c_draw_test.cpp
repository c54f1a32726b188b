// Tests that the C API, called from C99, draws the same pixels as the renderer, and streams through a
// callback that completes on other threads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/c/c_fixture.h"

namespace hearth::test
{

using testing::AllOf;
using testing::HasSubstr;

TEST_F(CApiTest, drawsTheImageOfTheRenderer)
{
    const c_image image = drawInC(makeFrame());
    expectEqual(image, drawInCpp({}));
    for (int i = 1; i < HEARTH_TIMESTAMP_COUNT; ++i)
        EXPECT_GE(image.ticks[i], image.ticks[i - 1]);
    EXPECT_GT(image.ticks[HEARTH_TIMESTAMP_SHADING], image.ticks[HEARTH_TIMESTAMP_BEGIN]);
}

TEST_F(CApiTest, handsOnAllThatAFrameSays)
{
    const hearth_lod_knot knots[] = {{0.5f, 0.7f}, {4, 1.3f}, {8, 0.2f}};
    const hearth_move move{0, {{1, 0, 0, 0.5f}, {0, 0, -1, 0.25f}, {0, 1, 0, -0.5f}}};
    hearth_frame frame = makeFrame();
    frame.error_pixels = 0.25f;
    frame.cull_flags = HEARTH_CULL_FRUSTUM | HEARTH_CULL_CONE;
    frame.lod_knots = knots;
    frame.lod_knot_count = 3;
    frame.moves = &move;
    frame.move_count = 1;
    frame.shaded_area = HEARTH_SHADE_TILES;
    frame.shift[0] = 0.25f;
    frame.shift[1] = -0.5f;
    shift_ = {0.25f, -0.5f};
    moved_ = Affine3{{{1, 0, 0, 0.5f}, {0, 0, -1, 0.25f}, {0, 1, 0, -0.5f}}};
    DrawOptions options{.error_pixels = 0.25f,
                        .flags = shared::kCullFrustum | shared::kCullCone,
                        .area = gpu::ShadedArea::tiles,
                        .lod_curve = {{0.5f, 0.7f}, {4, 1.3f}, {8, 0.2f}}};
    for (const uint32_t debug_view : {HEARTH_VIEW_FINAL, HEARTH_VIEW_LOD, HEARTH_VIEW_OVERDRAW})
    {
        frame.debug_view = options.debug_view = debug_view;
        const c_image image = drawInC(frame);
        expectEqual(image, drawInCpp(options));
    }
}

/// Makes images on the device of the C program.
class CColorTest : public CApiTest
{
protected:
    void SetUp() override
    {
        CApiTest::SetUp();
        const hearth_renderer_description caller = c_caller_description(caller_);
        auto device = gpu::makeDevice({.get_instance_proc_addr = caller.get_instance_proc_addr,
                                       .instance = caller.instance,
                                       .physical_device = caller.physical_device,
                                       .device = caller.device});
        ASSERT_TRUE(device.ok());
        device_ = std::move(*device);
        arena_ = std::make_unique<gpu::MemoryArena>(device_, 0);
    }

    void TearDown() override
    {
        images_.clear();
        arena_.reset();
        CApiTest::TearDown();
    }

    hearth_image makeColor(VkFormat format, const hearth_image_state& after)
    {
        auto image =
            arena_->createImage({.format = format,
                                 .extent = {kWidth, kHeight},
                                 .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                          VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
        HEARTH_ASSERT(image.ok());
        images_.push_back(std::move(*image));
        return {.image = images_.back().handle.get(),
                .format = format,
                .before = {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT, 0},
                .after = after};
    }

    gpu::Device device_;
    std::unique_ptr<gpu::MemoryArena> arena_;
    std::vector<gpu::Image> images_;
};

TEST_F(CColorTest, drawsIntoTheCallersImages)
{
    hearth_renderer_description description = c_caller_description(caller_);
    description.color_format = VK_FORMAT_B8G8R8A8_SRGB;
    recreateRenderer(description);
    const hearth_image_state drawn{
        VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
        VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT};
    const hearth_image_state sampled{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                     VK_PIPELINE_STAGE_VERTEX_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT};
    for (const hearth_image_state& after : {drawn, sampled})
    {
        in_parts_ = after.layout == sampled.layout;
        colors_ = {makeColor(VK_FORMAT_B8G8R8A8_SRGB, after), makeColor(VK_FORMAT_B8G8R8A8_SRGB, after)};
        const c_image image = drawInC(makeFrame());
        for (uint32_t& color : color_)
            color = (color & 0xFF00FF00u) | (color >> 16 & 255u) | (color & 255u) << 16;
        expectEqual(image, drawInCpp({}));
    }
}

TEST_F(CColorTest, imagesThatFramesCannotShowAreRefused)
{
    hearth_renderer_description renderer = c_caller_description(caller_);
    renderer.color_format = VK_FORMAT_R8_UNORM;
    hearth_renderer* none = nullptr;
    EXPECT_EQ(hearth_renderer_create(&renderer, &none, message_, sizeof(message_)), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, AllOf(HasSubstr("color_format"), HasSubstr("B10G11R11_UFLOAT_PACK32")));
    const hearth_image_state shown{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                   VK_ACCESS_TRANSFER_READ_BIT};
    const hearth_image good = makeColor(VK_FORMAT_R8G8B8A8_SRGB, shown);
    const auto refused = [&](const std::vector<hearth_image>& images, uint32_t count)
    {
        hearth_targets_description description = HEARTH_TARGETS_DESCRIPTION_INIT;
        description.width = kWidth;
        description.height = kHeight;
        description.colors = images.empty() ? nullptr : images.data();
        description.color_count = count;
        hearth_targets* targets = nullptr;
        EXPECT_EQ(hearth_targets_create(renderer_, &description, &targets), HEARTH_ERROR_USAGE);
        EXPECT_EQ(targets, nullptr);
        return std::string(hearth_last_error(renderer_));
    };
    EXPECT_THAT(refused({}, 1), HasSubstr("colors is NULL"));
    EXPECT_THAT(refused({good}, 0), HasSubstr("color_count is 0"));
    hearth_image bad = good;
    bad.image = VK_NULL_HANDLE;
    EXPECT_THAT(refused({good, bad}, 2), HasSubstr("image 1 of colors is VK_NULL_HANDLE"));
    bad = good;
    bad.format = VK_FORMAT_R8G8B8A8_UNORM;
    EXPECT_THAT(refused({bad}, 1),
                HasSubstr("has VkFormat 37, and the renderer's color_format is R8G8B8A8_SRGB"));
    bad = good;
    bad.after.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    EXPECT_THAT(refused({bad}, 1), HasSubstr("after.layout"));
    bad = good;
    bad.before.stages = VK_PIPELINE_STAGE_HOST_BIT;
    EXPECT_THAT(refused({good, bad}, 2), HasSubstr("another `before` or `after` than image 0"));
}

TEST_F(CColorTest, radianceHasNoPhotoFilter)
{
    hearth_renderer_description description = c_caller_description(caller_);
    description.color_format = VK_FORMAT_R16G16B16A16_SFLOAT;
    description.features = HEARTH_FEATURE_GRADING;
    recreateRenderer(description);
    c_image image{};
    image.scene = HEARTH_SCENE_OPTIONS_INIT;
    image.frame = makeFrame();
    image.frame.filter_density = 0.5f;
    image.width = kWidth;
    image.height = kHeight;
    EXPECT_EQ(c_caller_draw(caller_, renderer_, pack_, &image), HEARTH_ERROR_USAGE);
    EXPECT_THAT(hearth_last_error(renderer_), HasSubstr("ahead of the tone curve"));
}

TEST_F(CApiTest, bloomsAtAnotherSize)
{
    hearth_renderer_description description = c_caller_description(caller_);
    description.features = HEARTH_FEATURE_FINAL_PASS;
    recreateRenderer(description);
    hearth_targets_description size = HEARTH_TARGETS_DESCRIPTION_INIT;
    size.width = 32;
    size.height = 24;
    size.output_width = 64;
    size.output_height = 48;
    size.flags = HEARTH_TARGETS_BLOOM;
    hearth_targets* targets = nullptr;
    ASSERT_EQ(hearth_targets_create(renderer_, &size, &targets), HEARTH_OK) << hearth_last_error(renderer_);
    hearth_targets_info info = HEARTH_TARGETS_INFO_INIT;
    ASSERT_EQ(hearth_targets_get_info(targets, &info), HEARTH_OK);
    EXPECT_EQ(info.width, 32u);
    EXPECT_EQ(info.color.after.layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    hearth_scene* scene = nullptr;
    hearth_frame frame = makeFrame();
    frame.automatic_exposure = 1;
    frame.exposure_time_step = 0.1f;
    frame.bloom_strength = 0.1f;
    frame.exposure_stops = 1;
    frame.filter_density = 0.5f;
    const hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    VkCommandBuffer commands = c_caller_begin(caller_);
    ASSERT_EQ(hearth_scene_upload(renderer_, pack_, commands, &options, &scene), HEARTH_OK);
    ASSERT_EQ(c_caller_submit(caller_), VK_SUCCESS);
    for (int i = 0; i < 2; ++i)
    {
        commands = c_caller_begin(caller_);
        EXPECT_EQ(hearth_record_frame(scene, targets, commands, &frame), HEARTH_OK)
            << hearth_last_error(renderer_);
        ASSERT_EQ(c_caller_submit(caller_), VK_SUCCESS);
    }
    EXPECT_EQ(hearth_scene_destroy(scene), HEARTH_OK);
    EXPECT_EQ(hearth_targets_destroy(targets), HEARTH_OK);
}

TEST_F(CApiTest, castsTheShadowsOfTheRenderer)
{
    std::vector<uint32_t> shadows_of_clusters;
    for (const auto& [depth_bits, casters] : {std::pair{32u, gpu::Casters::clusters},
                                              {16u, gpu::Casters::clusters},
                                              {32u, gpu::Casters::proxies}})
    {
        SCOPED_TRACE(depth_bits);
        const hearth_shadow_sphere sphere{.center = {0, 0.5f, 0}, .radius = 1, .light = 0, .texels = 0};
        hearth_frame frame = makeFrame();
        frame.shadow_spheres = &sphere;
        frame.shadow_sphere_count = 1;
        hearth_scene_options c_options = HEARTH_SCENE_OPTIONS_INIT;
        c_options.shadows.max_maps = 4;
        c_options.shadows.texels = 256;
        c_options.shadows.splits = 2;
        c_options.shadows.split_far = 20;
        c_options.shadows.depth_bits = depth_bits;
        c_options.shadows.casters = static_cast<uint32_t>(casters);
        shadows_ = {.max_maps = 4, .texels = 256, .splits = 2, .split_range = {.far = 20}};
        shadows_.depth = depth_bits == 16 ? gpu::ShadowDepth::d16 : gpu::ShadowDepth::d32;
        shadows_.casters = casters;
        const gpu::ShadowSphere cpp_sphere{.center = {0, 0.5f, 0}, .radius = 1, .light = 0};
        DrawOptions options;
        options.shadow_spheres = {&cpp_sphere, 1};
        drawInC(makeFrame());
        const std::vector<uint32_t> lit_color = color_;
        for (const uint32_t debug_view : {HEARTH_VIEW_FINAL, HEARTH_VIEW_SHADOW_MAPS})
        {
            frame.debug_view = options.debug_view = debug_view;
            expectEqual(drawInC(frame, c_options), drawInCpp(options));
            EXPECT_NE(color_, lit_color);
            if (casters == gpu::Casters::clusters && debug_view == HEARTH_VIEW_FINAL)
                shadows_of_clusters = color_;
            else
                EXPECT_NE(color_, shadows_of_clusters);
        }
    }
}

TEST_F(CApiTest, readsOnOtherThreadsEndInTheImageOfTheWhole)
{
    Reader reader{.pack = pack_, .threads = {}};
    hearth_frame frame = makeFrame();
    frame.error_pixels = 0.5f;
    const c_image image = drawInC(frame, streamedBy(reader));
    expectEqual(image, drawInCpp({.error_pixels = 0.5f}));
    EXPECT_GT(reader.threads.size(), 4u) << "or nothing was streamed";
    EXPECT_GT(image.streaming.settled_serial, 1u);
    EXPECT_GT(image.streaming.bytes_streamed, 0u);
    EXPECT_LE(image.streaming.bytes_in_use, image.streaming.budget_bytes);
    EXPECT_EQ(image.streaming.error_scale, 1);
    EXPECT_EQ(image.streaming.failures, 0u);
}

TEST_F(CApiTest, aReadThatFailsIsCountedAndTheImageIsDrawn)
{
    Reader reader{.pack = pack_, .threads = {}};
    reader.bad_page = static_cast<uint32_t>(view_->meshes()[0].pages.first + 1);
    hearth_frame frame = makeFrame();
    frame.error_pixels = 0;
    const c_image image = drawInC(frame, streamedBy(reader));
    EXPECT_EQ(image.streaming.failures, 1u);
    EXPECT_EQ(image.streaming.reads_in_flight, 0u);
}

TEST_F(CApiTest, clustersBeyondTheCapacityAreCounted)
{
    hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    options.max_visible_clusters = 8;
    const c_image image = drawInC(makeFrame(), options);
    EXPECT_GT(image.counters.drawn_clusters, 8u);
    EXPECT_EQ(image.counters.dropped_clusters, image.counters.drawn_clusters - 8);
}

} // namespace hearth::test
