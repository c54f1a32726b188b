// Tests characters and clips through hearth.h: the same images as by the C++ classes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/hearth.hpp"
#include "tests/runtime/c/c_fixture.h"
#include "tests/runtime/gpu/animated_rocks.h"
#include "tests/runtime/gpu/deformed_scene.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shapes.h"

#include "runtime/pack/light_player.h"

namespace hearth::test
{

namespace
{

class CPoseTest : public CApiTest
{
protected:
    /// Open this pack instead of the fixture's.
    void open(const formats::PackView& view, const AlignedBytes& bytes)
    {
        ASSERT_EQ(hearth_pack_close(pack_), HEARTH_OK);
        pack_ = nullptr;
        ASSERT_EQ(hearth_pack_open_memory(bytes.span().data(), bytes.size(), "test", &pack_, message_,
                                          sizeof(message_)),
                  HEARTH_OK)
            << message_;
        view_ = view;
    }
};

hearth_pose toC(const TestPose& pose)
{
    return {pose.instance,
            static_cast<uint32_t>(pose.world_from_bind.size()),
            reinterpret_cast<const hearth_transform*>(pose.world_from_bind.data()),
            pose.morph_weights.data(),
            static_cast<uint32_t>(pose.morph_weights.size()),
            pose.free ? 1u : 0u};
}

} // namespace

TEST_F(CPoseTest, posesAreDrawnAsByTheClasses)
{
    std::mt19937 random(71);
    DeformedScene test({.rings = 60}, 31);
    open(test.pack(), test.bytes());
    std::vector<TestPose> poses;
    std::vector<hearth_pose> c_poses;
    for (const uint32_t instance : test.deformedInstances())
        poses.push_back(poses.size() % 3 == 2 ? test.freePose(instance, random)
                                              : test.randomPose(instance, random));
    for (const TestPose& pose : poses)
        c_poses.push_back(toC(pose));
    hearth_frame frame = makeFrame();
    frame.poses = c_poses.data();
    frame.pose_count = static_cast<uint32_t>(c_poses.size());
    const auto views = makeViews(poses);
    for (const uint64_t skinning_bytes : {uint64_t{16} << 20, uint64_t{0}})
    {
        hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
        options.skinning_bytes = skinning_bytes;
        const c_image image = drawInC(frame, options);
        expectEqual(image, drawInCpp({.poses = views}));
    }
}

TEST_F(CPoseTest, posesThatCannotBeAreRefused)
{
    std::mt19937 random(72);
    DeformedScene test({.limbs = 1, .tentacles = 1, .blobs = 1, .rocks = 1}, 32);
    open(test.pack(), test.bytes());
    TestPose good = test.randomPose(test.deformedInstances()[0], random);
    hearth_targets* targets = nullptr;
    ASSERT_EQ(createTargets(renderer_, 16, 16, &targets), HEARTH_OK);
    hearth_scene* scene = nullptr;
    const hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    const VkCommandBuffer commands = c_caller_begin(caller_);
    ASSERT_EQ(hearth_scene_upload(renderer_, pack_, commands, &options, &scene), HEARTH_OK);
    ASSERT_EQ(c_caller_submit(caller_), VK_SUCCESS);
    const auto draw = [&](const hearth_pose& pose)
    {
        hearth_frame frame = makeFrame();
        frame.poses = &pose;
        frame.pose_count = 1;
        const hearth_result result = hearth_record_frame(scene, targets, c_caller_begin(caller_), &frame);
        EXPECT_EQ(c_caller_submit(caller_), VK_SUCCESS);
        return result;
    };
    EXPECT_EQ(draw(toC(good)), HEARTH_OK);
    hearth_pose rigid = toC(good), few = toC(good), missing = toC(good);
    rigid.instance = 0;
    few.joint_count -= 1;
    missing.world_from_bind = nullptr;
    for (const hearth_pose& bad : {rigid, few, missing})
        EXPECT_EQ(draw(bad), HEARTH_ERROR_USAGE) << hearth_last_error(renderer_);
    good.world_from_bind[1].m[2][3] = std::numeric_limits<double>::infinity();
    EXPECT_EQ(draw(toC(good)), HEARTH_ERROR_USAGE);
    EXPECT_THAT(hearth_last_error(renderer_), testing::HasSubstr("not finite"));
    EXPECT_EQ(hearth_scene_destroy(scene), HEARTH_OK);
    EXPECT_EQ(hearth_targets_destroy(targets), HEARTH_OK);
}

TEST_F(CPoseTest, aPlayerMovesWhatItsClipsMove)
{
    TestScene test;
    fillAnimatedRocks(test, test.addMesh(withMaterial(shapes::rock(20, 0.3f), kInvalidIndex)));
    const formats::PackView view = test.build();
    const AlignedBytes bytes = test.model().bytes();
    open(view, bytes);

    uint32_t slide = 0, rise = 0;
    double seconds = 0;
    ASSERT_EQ(hearth_pack_find_animation(pack_, "slide", &slide, &seconds, message_, sizeof(message_)),
              HEARTH_OK);
    EXPECT_EQ(seconds, 4);
    ASSERT_EQ(hearth_pack_find_animation(pack_, "1", &rise, nullptr, message_, sizeof(message_)), HEARTH_OK);
    EXPECT_EQ(hearth_pack_find_animation(pack_, "fall", &rise, nullptr, message_, sizeof(message_)),
              HEARTH_ERROR_USAGE);

    Pack pack(pack_);
    Player player;
    std::string message;
    ASSERT_EQ(Player::create(pack, player, &message), HEARTH_OK) << message;
    EXPECT_EQ(hearth_pack_close(pack.get()), HEARTH_ERROR_IN_USE);
    const hearth_clip from{slide, 0, 3}, to{rise, 0, 2}, none{7, 0, 0};
    EXPECT_EQ(player.goTo(&none, nullptr, 0, &message), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message, testing::HasSubstr("animation 7"));
    EXPECT_EQ(player.goTo(&from, &to, 1.5, &message), HEARTH_ERROR_USAGE);
    EXPECT_EQ(player.goTo(nullptr, &to, 0.5, &message), HEARTH_ERROR_USAGE);
    ASSERT_EQ(player.goTo(&from, &to, 0.5, &message), HEARTH_OK) << message;
    hearth_player_info pose = HEARTH_PLAYER_INFO_INIT;
    ASSERT_EQ(player.getInfo(pose), HEARTH_OK);
    EXPECT_EQ(pose.pose_count, 0u);
    ASSERT_EQ(pose.move_count, 3u);
    EXPECT_EQ(pose.moves[0].world_from_object[0][3], 3.5f);
    EXPECT_EQ(pose.moves[0].world_from_object[1][3], 1.0f);
    (void)pack.release();
}

TEST_F(CPoseTest, aPlayerLightsWhatFlickersAndMoves)
{
    TestScene test;
    fillAnimatedRocks(test, test.addMesh(withMaterial(shapes::rock(20, 0.3f), kInvalidIndex)));
    test.addLight(light(formats::LightType::point, {0, 1, 2}, {0, -1, 0}, 10));
    test.addLight(light(formats::LightType::spot, {2, 3, 1}, {0, -1, -0.5f}, 40));
    formats::LightRecord& lamp = test.model().lights[0];
    lamp.flicker_rate = 4, lamp.flicker_amplitude = 0.5f, lamp.flicker_seed = 3;
    test.model().lights[1].node = test.model().instances[1].node;
    const formats::PackView view = test.build();
    const AlignedBytes bytes = test.model().bytes();
    open(view, bytes);
    pack::PosePlayer poses(view);
    pack::LightPlayer expected(view);
    poses.play({0, 3});
    expected.update(poses, 1.7);

    Pack pack(pack_);
    Player player;
    std::string message;
    ASSERT_EQ(Player::create(pack, player, &message), HEARTH_OK) << message;
    hearth_player_lights lights = HEARTH_PLAYER_LIGHTS_INIT;
    EXPECT_EQ(player.getLights(std::numeric_limits<double>::infinity(), lights, &message),
              HEARTH_ERROR_USAGE);
    EXPECT_THAT(message, testing::HasSubstr("flicker_seconds is not finite"));
    const hearth_clip slide{0, 0, 3};
    ASSERT_EQ(player.goTo(&slide), HEARTH_OK);
    ASSERT_EQ(player.getLights(1.7, lights, &message), HEARTH_OK) << message;
    ASSERT_EQ(lights.changed_count, 2u);
    ASSERT_EQ(lights.light_count, 2u);
    EXPECT_EQ(lights.changed[0].intensity, expected.lights()[0].record.intensity);
    EXPECT_LT(lights.changed[0].intensity, 10);
    EXPECT_EQ(lights.changed[0].steady_intensity, 10);
    EXPECT_EQ(lights.lights[1].world_from_light[0][3], 5);

    hearth_player_info pose = HEARTH_PLAYER_INFO_INIT;
    ASSERT_EQ(player.getInfo(pose), HEARTH_OK);
    hearth_frame frame = makeFrame();
    frame.moves = pose.moves, frame.move_count = pose.move_count;
    frame.lights = lights.changed, frame.light_count = lights.changed_count;
    (void)drawInC(frame);
    const std::vector<uint32_t> lit = color_;
    frame.light_count = 0;
    (void)drawInC(frame);
    EXPECT_NE(color_, lit);

    ASSERT_EQ(player.getLights(1.7, lights), HEARTH_OK);
    EXPECT_EQ(lights.changed_count, 0u) << "the same time";
    EXPECT_EQ(lights.light_count, 2u);
    lights.struct_size = 4;
    EXPECT_EQ(player.getLights(1.7, lights, &message), HEARTH_ERROR_USAGE);
    (void)pack.release();
}

TEST_F(CPoseTest, gamesAddLightsOfTheirOwn)
{
    TestScene test;
    test.addInstance(test.addMesh(withMaterial(shapes::rock(8, 0.3f), kInvalidIndex)), Affine3{});
    test.addLight(light(formats::LightType::directional, {}, {0, -1, 0}, 0.1f));
    const formats::PackView view = test.build();
    const AlignedBytes bytes = test.model().bytes();
    open(view, bytes);
    hearth_frame frame = makeFrame();
    (void)drawInC(frame);
    const std::vector<uint32_t> dark = color_;
    hearth_light_change lamp{};
    lamp.light = 100; // the pack has one
    lamp.type = HEARTH_LIGHT_POINT;
    for (int axis = 0; axis < 3; ++axis)
        lamp.world_from_light[axis][axis] = 1;
    lamp.world_from_light[1][3] = 2;
    lamp.color[0] = 1;
    lamp.intensity = 3;
    lamp.range = 5;
    frame.lights = &lamp, frame.light_count = 1;
    (void)drawInC(frame);
    const std::vector<uint32_t> lit = color_;
    EXPECT_NE(lit, dark);
    frame.light_lists = HEARTH_LIGHT_LISTS_CPU;
    (void)drawInC(frame);
    EXPECT_EQ(color_, lit);
    const hearth_lamp_weight off{HEARTH_LAMP_LIGHT, lamp.light, {0, 0, 0}};
    frame.lamp_weights = &off, frame.lamp_weight_count = 1;
    (void)drawInC(frame);
    EXPECT_EQ(color_, dark);
    frame.lamp_weight_count = 0;
    lamp.intensity = 0;
    (void)drawInC(frame);
    EXPECT_EQ(color_, dark);
}

TEST_F(CPoseTest, daylightReplacesSkyAndSun)
{
    TestScene test;
    test.addInstance(test.addMesh(withMaterial(shapes::rock(8, 0.3f), kInvalidIndex)), Affine3{});
    const formats::PackView view = test.build();
    const AlignedBytes bytes = test.model().bytes();
    open(view, bytes);
    hearth_frame frame = makeFrame();
    (void)drawInC(frame);
    const std::vector<uint32_t> before = color_;
    const hearth_daylight evening{10, 200, 4, 0}, of_the_pack{};
    frame.daylight = &evening;
    (void)drawInC(frame);
    EXPECT_NE(color_, before);
    frame.daylight = &of_the_pack;
    (void)drawInC(frame);
    EXPECT_EQ(color_, before);
}

TEST_F(CPoseTest, changesOfLightsThatAreNotDrawnHaveNoEffect)
{
    TestScene test;
    test.addInstance(test.addMesh(withMaterial(shapes::rock(8, 0.3f), kInvalidIndex)), Affine3{});
    for (uint32_t i = 0; i < shared::kMaxLights + 2; ++i)
        test.addLight(light(formats::LightType::point, {0, 2, 0}, {0, -1, 0}, 1));
    const formats::PackView view = test.build();
    const AlignedBytes bytes = test.model().bytes();
    open(view, bytes);
    hearth_light_change change{};
    change.light = shared::kMaxLights + 1;
    std::copy_n(&view.lights()[0].world_from_light.m[0][0], 12, &change.world_from_light[0][0]);
    hearth_frame frame = makeFrame();
    (void)drawInC(frame);
    const std::vector<uint32_t> before = color_;
    frame.lights = &change, frame.light_count = 1;
    (void)drawInC(frame);
    EXPECT_EQ(color_, before);
}

} // namespace hearth::test
