// Tests hearth_helpers.h: its device draws what the renderer draws, and rejected arguments give an
// explanation.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/hearth_helpers.h"
#include "tests/runtime/c/c_fixture.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace hearth::test
{

namespace
{

using testing::HasSubstr;

class CHelpersTest : public CApiTest
{
protected:
    void SetUp() override
    {
        CApiTest::SetUp();
        hearth_device_options options = HEARTH_DEVICE_OPTIONS_INIT;
        options.name = host().deviceName().c_str();
        ASSERT_EQ(hearth_device_create(&options, &device_, message_, sizeof(message_)), HEARTH_OK)
            << message_;
        hearth_renderer_description description = HEARTH_RENDERER_DESCRIPTION_INIT;
        ASSERT_EQ(hearth_device_describe(device_, &description), HEARTH_OK);
        recreateRenderer(description);
    }

    void TearDown() override
    {
        EXPECT_EQ(hearth_renderer_destroy(renderer_), HEARTH_OK);
        renderer_ = nullptr;
        EXPECT_EQ(hearth_device_destroy(device_), HEARTH_OK);
        CApiTest::TearDown();
    }

    hearth_device* device_ = nullptr;
};

} // namespace

TEST_F(CHelpersTest, drawsAndReadsTheImageOfTheRenderer)
{
    const hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    const hearth_frame frame = makeFrame();
    hearth_targets_info images = HEARTH_TARGETS_INFO_INIT;
    hearth_scene* scene = nullptr;
    hearth_targets* targets = nullptr;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    ASSERT_EQ(createTargets(renderer_, kWidth, kHeight, &targets), HEARTH_OK);
    ASSERT_EQ(hearth_targets_get_info(targets, &images), HEARTH_OK);
    ASSERT_EQ(hearth_device_begin(device_, &commands), HEARTH_OK);
    ASSERT_EQ(hearth_scene_upload(renderer_, pack_, commands, &options, &scene), HEARTH_OK);
    ASSERT_EQ(hearth_device_submit(device_), HEARTH_OK);

    ASSERT_EQ(hearth_device_begin(device_, &commands), HEARTH_OK);
    ASSERT_EQ(hearth_device_discard(device_), HEARTH_OK);
    ASSERT_EQ(hearth_device_begin(device_, &commands), HEARTH_OK);
    ASSERT_EQ(hearth_record_frame(scene, targets, commands, &frame), HEARTH_OK);
    ASSERT_EQ(hearth_device_submit(device_), HEARTH_OK);
    const Image expected = drawInCpp({});
    std::vector<uint32_t> texels(kWidth * kHeight);
    const size_t bytes = texels.size() * sizeof(uint32_t);
    EXPECT_EQ(hearth_device_read_image(device_, &images.color, kWidth, kHeight, texels.data(), bytes),
              HEARTH_OK);
    EXPECT_EQ(texels, expected.color);
    EXPECT_EQ(hearth_device_read_image(device_, &images.visibility, kWidth, kHeight, texels.data(), bytes),
              HEARTH_OK);
    EXPECT_EQ(texels, expected.visibility);
    EXPECT_EQ(hearth_targets_destroy(targets), HEARTH_OK);
    EXPECT_EQ(hearth_scene_destroy(scene), HEARTH_OK);
}

TEST_F(CHelpersTest, aDeviceSaysWhatItIs)
{
    hearth_device_info info = HEARTH_DEVICE_INFO_INIT;
    ASSERT_EQ(hearth_device_get_info(device_, &info), HEARTH_OK);
    EXPECT_EQ(info.name, host().deviceName());
    EXPECT_EQ(info.is_software != 0, host().software());
    EXPECT_NE(info.queue, VkQueue{VK_NULL_HANDLE});
    EXPECT_EQ(info.queue_family, host().queueFamily());
    info.struct_size = 0;
    EXPECT_EQ(hearth_device_get_info(device_, &info), HEARTH_ERROR_USAGE);
    EXPECT_THAT(hearth_device_last_error(device_), HasSubstr("HEARTH_DEVICE_INFO_INIT"));
    hearth_renderer_description description = HEARTH_RENDERER_DESCRIPTION_INIT;
    description.struct_size = 0;
    EXPECT_EQ(hearth_device_describe(device_, &description), HEARTH_ERROR_USAGE);
}

TEST_F(CHelpersTest, aDeviceIsFoundByAPartOfItsName)
{
    hearth_device_options options = HEARTH_DEVICE_OPTIONS_INIT;
    hearth_device* device = nullptr;
    std::string name = host().deviceName().substr(1, 4);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    options.name = name.c_str();
    EXPECT_EQ(hearth_device_create(&options, &device, message_, sizeof(message_)), HEARTH_OK) << message_;
    EXPECT_EQ(hearth_device_destroy(device), HEARTH_OK);

    device = nullptr;
    options.name = "abacus";
    EXPECT_EQ(hearth_device_create(&options, &device, message_, sizeof(message_)), HEARTH_ERROR_DEVICE);
    EXPECT_THAT(message_, HasSubstr("\"abacus\""));
    EXPECT_THAT(message_, HasSubstr("hint: "));
    EXPECT_EQ(device, nullptr);
    options.struct_size = 4;
    EXPECT_EQ(hearth_device_create(&options, &device, message_, sizeof(message_)), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("HEARTH_DEVICE_OPTIONS_INIT"));
    EXPECT_EQ(hearth_device_create(nullptr, &device, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_device_create(&options, nullptr, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_device_destroy(nullptr), HEARTH_OK);
}

TEST_F(CHelpersTest, commandsBeginAndEndInTurn)
{
    const auto why = [&](hearth_result result)
    {
        EXPECT_EQ(result, HEARTH_ERROR_USAGE);
        return std::string(hearth_device_last_error(device_));
    };
    const hearth_image none = HEARTH_IMAGE_INIT;
    hearth_image some = none;
    some.image = reinterpret_cast<VkImage>(this); // not read
    VkCommandBuffer commands = VK_NULL_HANDLE;
    uint32_t texel = 0;
    EXPECT_STREQ(hearth_device_last_error(device_), "");
    EXPECT_THAT(why(hearth_device_submit(device_)), HasSubstr("hearth_device_begin has not been called"));
    EXPECT_THAT(why(hearth_device_discard(device_)), HasSubstr("hearth_device_begin has not been called"));
    EXPECT_THAT(why(hearth_device_begin(device_, nullptr)), HasSubstr("commands is NULL"));
    EXPECT_THAT(why(hearth_device_read_image(device_, &none, 1, 1, &texel, 4)), HasSubstr("image or texels"));
    EXPECT_THAT(why(hearth_device_read_image(device_, &some, 1, 1, &texel, 3)), HasSubstr("size"));
    ASSERT_EQ(hearth_device_begin(device_, &commands), HEARTH_OK);
    EXPECT_THAT(why(hearth_device_begin(device_, &commands)), HasSubstr("has not been submitted"));
    EXPECT_THAT(why(hearth_device_read_image(device_, &some, 1, 1, &texel, 4)),
                HasSubstr("has not been submitted"));
    EXPECT_EQ(hearth_device_submit(device_), HEARTH_OK);
    EXPECT_EQ(hearth_device_submit(nullptr), HEARTH_ERROR_USAGE);
}

TEST(CFitCamera, showsAllOfABoxAndLittleElse)
{
    const float box_min[3] = {-1, 2, 3}, box_max[3] = {4, 3, 9};
    for (const float aspect : {0.4f, 1.0f, 2.5f})
    {
        const hearth_camera camera = hearth_fit_camera(box_min, box_max, aspect);
        const Float3 eye{camera.position[0], camera.position[1], camera.position[2]};
        const Float3 target{camera.target[0], camera.target[1], camera.target[2]};
        const Float3 forward = normalizeOr(target - eye, {});
        const Float3 right = normalizeOr(cross(forward, {0, 1, 0}), {});
        const Float3 up = cross(right, forward);
        const float tan_y = std::tan(0.5f * camera.y_fov_rad);
        float largest = 0;
        for (int corner = 0; corner < 8; ++corner)
        {
            const Float3 to{(corner & 1 ? box_max : box_min)[0] - eye.x,
                            (corner & 2 ? box_max : box_min)[1] - eye.y,
                            (corner & 4 ? box_max : box_min)[2] - eye.z};
            const float depth = dot(to, forward);
            EXPECT_GT(depth, camera.z_near);
            largest = std::max({largest, std::abs(dot(to, up)) / (depth * tan_y),
                                std::abs(dot(to, right)) / (depth * tan_y * aspect)});
        }
        EXPECT_LT(largest, 1) << aspect;
        EXPECT_GT(largest, 0.4f) << aspect;
    }
}

TEST(CFitCamera, hasAPlaceWhereThereIsNothing)
{
    const float box_min[3] = {1, 1, 1}, box_max[3] = {-1, -1, -1};
    const hearth_camera camera = hearth_fit_camera(box_min, box_max, 1);
    EXPECT_EQ(camera.target[0], 0);
    EXPECT_GT(camera.position[2], 1);
    const hearth_camera point = hearth_fit_camera(box_min, box_min, 1);
    EXPECT_GT(point.position[2], 1);
    EXPECT_GT(point.z_near, 0);
}

} // namespace hearth::test
