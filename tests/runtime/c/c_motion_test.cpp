// Tests motions of vertices of a game (hearth_add_material_shaders): what moves is drawn, casts shadows and
// is culled where it is.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/hearth_helpers.h"
#include "tests/runtime/c/material_pack.h"

#include <algorithm>
#include <hearth_test_functions_material_shaders.h>

namespace hearth::test
{

namespace
{

using testing::HasSubstr;

/// Scene of a pack that frames are drawn of, one after the other.
class DrawnScene
{
public:
    DrawnScene(hearth_device* device, hearth_renderer* renderer, const MaterialPack& pack,
               const hearth_shadow_options& shadows, uint32_t flags = 0)
        : device_(device), renderer_(renderer)
    {
        hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
        options.shadows = shadows;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        EXPECT_EQ(hearth_device_begin(device, &commands), HEARTH_OK);
        EXPECT_EQ(hearth_scene_upload(renderer, pack.get(), commands, &options, &scene_), HEARTH_OK)
            << hearth_last_error(renderer);
        EXPECT_EQ(hearth_device_submit(device), HEARTH_OK);
        hearth_targets_description description = HEARTH_TARGETS_DESCRIPTION_INIT;
        description.width = kWidth;
        description.height = kHeight;
        description.flags = flags;
        EXPECT_EQ(hearth_targets_create(renderer, &description, &targets_), HEARTH_OK);
    }
    ~DrawnScene()
    {
        EXPECT_EQ(hearth_targets_destroy(targets_), HEARTH_OK);
        EXPECT_EQ(hearth_scene_destroy(scene_), HEARTH_OK);
    }
    DrawnScene(const DrawnScene&) = delete;
    DrawnScene& operator=(const DrawnScene&) = delete;

    hearth_scene* get() const { return scene_; }

    std::vector<uint32_t> draw(const hearth_frame& frame)
    {
        if (frame.light_method != HEARTH_LIGHTS_PRACTICAL)
            EXPECT_EQ(hearth_scene_prepare_lights(scene_, frame.light_method), HEARTH_OK);
        VkCommandBuffer commands = VK_NULL_HANDLE;
        EXPECT_EQ(hearth_device_begin(device_, &commands), HEARTH_OK);
        EXPECT_EQ(hearth_record_frame(scene_, targets_, commands, &frame), HEARTH_OK)
            << hearth_last_error(renderer_);
        EXPECT_EQ(hearth_device_submit(device_), HEARTH_OK);
        hearth_targets_info info = HEARTH_TARGETS_INFO_INIT;
        EXPECT_EQ(hearth_targets_get_info(targets_, &info), HEARTH_OK);
        std::vector<uint32_t> color(kWidth * kHeight);
        EXPECT_EQ(hearth_device_read_image(device_, &info.color, kWidth, kHeight, color.data(),
                                           color.size() * sizeof(uint32_t)),
                  HEARTH_OK);
        return color;
    }

private:
    hearth_device* device_;
    hearth_renderer* renderer_;
    hearth_scene* scene_ = nullptr;
    hearth_targets* targets_ = nullptr;
};

constexpr hearth_shadow_options kNoShadows = HEARTH_SHADOW_OPTIONS_INIT;

hearth_shadow_options shadowMaps(uint32_t moving_layers)
{
    hearth_shadow_options shadows = HEARTH_SHADOW_OPTIONS_INIT;
    shadows.max_maps = 8;
    shadows.texels = 256;
    shadows.moving_layers = moving_layers;
    return shadows;
}

/// Pixels that differ by more than 4 of 255 in a channel.
size_t countDifferent(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b)
{
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i)
        for (uint32_t shift = 0; shift < 24; shift += 8)
            if (std::abs(static_cast<int>(a[i] >> shift & 255) - static_cast<int>(b[i] >> shift & 255)) > 4)
            {
                ++count;
                break;
            }
    return count;
}

const std::string kSway = R"({"hearth_motion":"sway","hearth_motion_bound":2,"hearth_parameters":[0.5]})";

} // namespace

class CMotionTest : public CApiTest
{
protected:
    void SetUp() override
    {
        CApiTest::SetUp();
        hearth_device_options options = HEARTH_DEVICE_OPTIONS_INIT;
        options.name = host().deviceName().c_str();
        ASSERT_EQ(hearth_device_create(&options, &device_, message_, sizeof(message_)), HEARTH_OK)
            << message_;
        recreate(HEARTH_FEATURE_DEFERRED);
    }

    void TearDown() override
    {
        EXPECT_EQ(hearth_renderer_destroy(renderer_), HEARTH_OK);
        renderer_ = nullptr;
        EXPECT_EQ(hearth_device_destroy(device_), HEARTH_OK);
        CApiTest::TearDown();
    }

    void recreate(uint32_t features)
    {
        hearth_renderer_description description = HEARTH_RENDERER_DESCRIPTION_INIT;
        ASSERT_EQ(hearth_device_describe(device_, &description), HEARTH_OK);
        description.material_shaders = &hearth_test_functions_material_shaders;
        description.features |= features;
        recreateRenderer(description);
    }

    hearth_device* device_ = nullptr;
};

TEST_F(CMotionTest, drawsWhatMovesWhereTheMotionPutsIt)
{
    const std::string extras =
        R"({"hearth_motion":"shift","hearth_motion_bound":2,"hearth_parameters":[0.5,0.25,-0.5]})";
    constexpr std::pair<uint32_t, uint32_t> kMethods[] = {
        {HEARTH_LIGHTS_PRACTICAL, 0},
        {HEARTH_LIGHTS_FORWARD, 0},
        {HEARTH_LIGHTS_DEFERRED, HEARTH_TARGETS_DEFERRED},
        {HEARTH_LIGHTS_ENCODED_PREPASS, HEARTH_TARGETS_ENCODED_PREPASS}};
    for (const formats::AlphaMode mode : {formats::AlphaMode::opaque, formats::AlphaMode::mask})
    {
        formats::MaterialRecord material = doubleSided(plainMaterial());
        material.alpha_mode = static_cast<uint32_t>(mode);
        const MaterialPack pack(material, extras), rest(material, ""),
            there(material, "", {}, {0.5f, 0.25f, -0.5f});
        for (const auto& [method, flags] : kMethods)
        {
            hearth_frame frame = makeFrame();
            frame.light_method = method;
            frame.error_pixels = 0; // what may move nearer is finer
            DrawnScene moved(device_, renderer_, pack, shadowMaps(1), flags);
            DrawnScene expected(device_, renderer_, there, shadowMaps(1), flags);
            const std::vector<uint32_t> color = moved.draw(frame);
            EXPECT_LE(countDifferent(color, expected.draw(frame)), color.size() / 200) << method;
            DrawnScene still(device_, renderer_, rest, shadowMaps(1), flags);
            EXPECT_GT(countDifferent(color, still.draw(frame)), color.size() / 20) << method;
        }
    }
}

TEST_F(CMotionTest, noVertexMovesFartherThanTheBound)
{
    const MaterialPack pack(
        doubleSided(plainMaterial()),
        R"({"hearth_motion":"shift","hearth_motion_bound":1,"hearth_parameters":[0.5,0,0]})");
    const MaterialPack there(doubleSided(plainMaterial()), "", {}, {1, 0, 0});
    hearth_frame frame = makeFrame();
    DrawnScene expected(device_, renderer_, there, kNoShadows);
    const std::vector<uint32_t> plain = expected.draw(frame);
    DrawnScene moved(device_, renderer_, pack, kNoShadows);
    for (const float input : {1.0f, 7.0f, 1e6f})
    {
        frame.material_inputs[3] = input;
        EXPECT_LE(countDifferent(moved.draw(frame), plain), plain.size() / 200) << input;
    }
}

TEST_F(CMotionTest, cullingLeavesOutNothingThatMoves)
{
    std::mt19937 random(3);
    const MaterialPack pack(plainMaterial(), kSway);
    DrawnScene culled(device_, renderer_, pack, kNoShadows), whole(device_, renderer_, pack, kNoShadows);
    hearth_frame frame = makeFrame();
    size_t covered = 0;
    for (int i = 0; i < 60; ++i)
    {
        const shared::Camera camera = randomCamera(random, 3);
        frame.camera = {{camera.position.x, camera.position.y, camera.position.z},
                        {camera.target.x, camera.target.y, camera.target.z},
                        {camera.up.x, camera.up.y, camera.up.z},
                        camera.y_fov_rad,
                        camera.z_near};
        frame.material_inputs[0] = static_cast<float>(i) * 0.4f;
        frame.cull_flags = HEARTH_CULL_EVERYTHING;
        const std::vector<uint32_t> color = culled.draw(frame);
        frame.cull_flags = 0;
        ASSERT_EQ(color, whole.draw(frame)) << i;
        covered +=
            static_cast<size_t>(std::count(color.begin(), color.end(), color.front())) < color.size() ? 1 : 0;
    }
    EXPECT_GT(covered, 20u);
}

TEST_F(CMotionTest, shadowsFollowTheInputsOfAFrame)
{
    const MaterialPack pack(doubleSided(plainMaterial()), kSway);
    for (const uint32_t moving_layers : {0u, 1u})
    {
        DrawnScene scene(device_, renderer_, pack, shadowMaps(moving_layers));
        std::vector<uint32_t> last;
        for (const float input : {0.0f, 1.5f, 1.5f, 4.0f})
        {
            hearth_frame frame = makeFrame();
            frame.material_inputs[0] = input;
            const std::vector<uint32_t> color = scene.draw(frame);
            DrawnScene fresh(device_, renderer_, pack, shadowMaps(moving_layers));
            EXPECT_EQ(color, fresh.draw(frame)) << input;
            hearth_shadow_counters counters = HEARTH_SHADOW_COUNTERS_INIT;
            ASSERT_EQ(hearth_scene_get_shadow_counters(scene.get(), &counters), HEARTH_OK);
            EXPECT_EQ(counters.drawn_maps + counters.moved_maps > 0, color != last) << input;
            last = color;
        }
    }
}

TEST_F(CMotionTest, errorsNameTheMaterialAndTheRemedy)
{
    const auto refusal = [&](const std::string& extras)
    {
        const MaterialPack pack(unlit(), extras);
        const hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
        hearth_scene* scene = nullptr;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        EXPECT_EQ(hearth_device_begin(device_, &commands), HEARTH_OK);
        EXPECT_EQ(hearth_scene_upload(renderer_, pack.get(), commands, &options, &scene), HEARTH_ERROR_USAGE)
            << extras;
        EXPECT_EQ(hearth_device_discard(device_), HEARTH_OK);
        return std::string(hearth_last_error(renderer_));
    };
    EXPECT_THAT(refusal(R"({"hearth_motion":"swim","hearth_motion_bound":1})"),
                AllOf(HasSubstr("rock.hearth"), HasSubstr("\"swim\""), HasSubstr("sway")));
    for (const char* bound : {"", R"(,"hearth_motion_bound":0)", R"(,"hearth_motion_bound":-1)",
                              R"(,"hearth_motion_bound":"1")", R"(,"hearth_motion_bound":1e60)"})
        EXPECT_THAT(refusal(R"({"hearth_motion":"sway")" + std::string(bound) + "}"),
                    HasSubstr("hearth_motion_bound"))
            << bound;
    EXPECT_THAT(refusal(R"({"hearth_motion":"sway","hearth_motion_bound":1e30})"), HasSubstr("too small"));

    const MaterialPack pack(unlit(), kSway);
    DrawnScene scene(device_, renderer_, pack, kNoShadows, HEARTH_TARGETS_SPLIT);
    EXPECT_EQ(hearth_scene_prepare_lights(scene.get(), HEARTH_LIGHTS_TILED_FORWARD), HEARTH_ERROR_USAGE);
    EXPECT_THAT(hearth_last_error(renderer_), HasSubstr("use another one"));
}

} // namespace hearth::test
