// Tests the additions of hearth.h 1.1: frames in parts, the caller's memory, messages; and compatibility with
// callers of 1.0.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/frame/frame_parts.h"
#include "tests/runtime/c/c_fixture.h"

#include <cstddef>

namespace hearth::test
{

namespace
{

void expectEqual(const hearth_image_state& c, const gpu::ImageState& cpp)
{
    EXPECT_EQ(c.layout, cpp.layout);
    EXPECT_EQ(c.stages, cpp.stages);
    EXPECT_EQ(c.access, cpp.access);
}

} // namespace

TEST_F(CApiTest, drawsInPartsTheImageOfTheRenderer)
{
    in_parts_ = true;
    hearth_frame frame = makeFrame();
    for (const gpu::ShadedArea area : {gpu::ShadedArea::wholeFrame, gpu::ShadedArea::tiles})
    {
        frame.shaded_area = static_cast<uint32_t>(area);
        const c_image image = drawInC(frame);
        expectEqual(image, drawInCpp({.area = area}));
    }
    Reader reader{.pack = pack_, .threads = {}};
    const c_image streamed = drawInC(makeFrame(), streamedBy(reader));
    expectEqual(streamed, drawInCpp({}));
}

TEST_F(CApiTest, partsComeInOrderWithTheSameTargets)
{
    const hearth_frame frame = makeFrame();
    const hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    hearth_targets *targets = nullptr, *others = nullptr;
    hearth_scene* scene = nullptr;
    ASSERT_EQ(createTargets(renderer_, 16, 16, &targets), HEARTH_OK);
    ASSERT_EQ(createTargets(renderer_, 16, 16, &others), HEARTH_OK);
    ASSERT_EQ(hearth_scene_upload(renderer_, pack_, c_caller_begin(caller_), &options, &scene), HEARTH_OK);
    ASSERT_EQ(c_caller_submit(caller_), VK_SUCCESS);
    const VkCommandBuffer commands = c_caller_begin(caller_);
    EXPECT_EQ(hearth_record_visibility(scene, targets, commands, &frame), HEARTH_ERROR_USAGE);
    EXPECT_THAT(hearth_last_error(renderer_), testing::HasSubstr("recorded in order, with the same targets"));
    EXPECT_EQ(hearth_record_cull(scene, targets, commands, &frame), HEARTH_OK);
    EXPECT_EQ(hearth_record_materials(scene, targets, commands, &frame), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_record_visibility(scene, others, commands, &frame), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_record_visibility(scene, targets, commands, &frame), HEARTH_OK);
    EXPECT_EQ(hearth_record_materials(scene, targets, commands, &frame), HEARTH_OK);
    EXPECT_EQ(hearth_record_materials(scene, targets, commands, &frame), HEARTH_ERROR_USAGE);
    EXPECT_EQ(c_caller_submit(caller_), VK_SUCCESS);
    EXPECT_EQ(hearth_scene_destroy(scene), HEARTH_OK);
    EXPECT_EQ(hearth_targets_destroy(others), HEARTH_OK);
    EXPECT_EQ(hearth_targets_destroy(targets), HEARTH_OK);
}

TEST_F(CApiTest, partsSayWhatTheyDoWithTheImages)
{
    hearth_targets* targets = nullptr;
    ASSERT_EQ(createTargets(renderer_, 16, 16, &targets), HEARTH_OK);
    for (uint32_t part = HEARTH_PART_CULL; part <= HEARTH_PART_MATERIALS; ++part)
    {
        hearth_part_info info = HEARTH_PART_INFO_INIT;
        ASSERT_EQ(hearth_targets_get_part_info(targets, part, &info), HEARTH_OK);
        const gpu::PartImages images = gpu::partImages(static_cast<gpu::FramePart>(part), true);
        test::expectEqual(info.color.before, images.color.before);
        test::expectEqual(info.color.after, images.color.after);
        test::expectEqual(info.visibility.before, images.visibility.before);
        test::expectEqual(info.visibility.after, images.visibility.after);
    }
    hearth_part_info info = HEARTH_PART_INFO_INIT;
    EXPECT_EQ(hearth_targets_get_part_info(targets, 3, &info), HEARTH_ERROR_USAGE);
    info.struct_size = 0;
    EXPECT_EQ(hearth_targets_get_part_info(targets, 0, &info), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_targets_destroy(targets), HEARTH_OK);
}

TEST_F(CApiTest, memoryComesFromTheCallerAndGoesBack)
{
    hearth_renderer_description description = c_caller_description(caller_);
    description.memory = c_caller_memory(caller_);
    recreateRenderer(description);
    const c_image image = drawInC(makeFrame());
    expectEqual(image, drawInCpp({}));
    EXPECT_GT(c_caller_all_pieces(caller_), 20u);
    EXPECT_EQ(c_caller_live_pieces(caller_), 0u);

    description.memory.free = nullptr;
    hearth_renderer* renderer = nullptr;
    EXPECT_EQ(hearth_renderer_create(&description, &renderer, message_, sizeof(message_)),
              HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, testing::HasSubstr("one function and not the other"));
}

TEST_F(CApiTest, messagesTellWhatIsDegraded)
{
    std::vector<std::string> messages;
    hearth_renderer_description description = c_caller_description(caller_);
    description.features = HEARTH_FEATURE_DEBUG_LABELS;
    description.message = [](void* user, const char* message)
    { static_cast<std::vector<std::string>*>(user)->emplace_back(message); };
    description.message_user = &messages;
    recreateRenderer(description);
    Reader reader{.pack = pack_, .threads = {}};
    reader.bad_page = static_cast<uint32_t>(view_->meshes()[0].pages.first + 1);
    hearth_frame frame = makeFrame();
    frame.error_pixels = 0;
    (void)drawInC(frame, streamedBy(reader));
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_THAT(messages[0], testing::HasSubstr("page " + std::to_string(reader.bad_page)));
}

TEST_F(CApiTest, descriptionsOfVersionOneOneAreTaken)
{
    hearth_renderer_description description = c_caller_description(caller_);
    description.api_version = 0x00010001u;
    description.struct_size = offsetof(hearth_renderer_description, frame_way);
    description.frame_way = 77; // refused if it were read
    recreateRenderer(description);
    expectEqual(drawInC(makeFrame()), drawInCpp({}));
}

TEST_F(CApiTest, everyWayThroughAFrameDrawsTheSame)
{
    hearth_renderer_description description = c_caller_description(caller_);
    for (const uint32_t way :
         {HEARTH_FRAME_AUTOMATIC, HEARTH_FRAME_MERGED, HEARTH_FRAME_SEPARATE, HEARTH_FRAME_ONE_SET})
    {
        description.frame_way = way;
        recreateRenderer(description);
        expectEqual(drawInC(makeFrame()), drawInCpp({}));
    }
}

TEST_F(CApiTest, descriptionsOfVersionOneZeroAreTaken)
{
    hearth_renderer_description description = c_caller_description(caller_);
    description.api_version = 0x00010000u;
    description.struct_size = offsetof(hearth_renderer_description, memory);
    // The memory of such a caller has other content there. One function of the two would be rejected if it
    // were read.
    description.memory = c_caller_memory(caller_);
    description.memory.free = nullptr;
    recreateRenderer(description);
    const c_image image = drawInC(makeFrame());
    expectEqual(image, drawInCpp({}));
}

} // namespace hearth::test
