// Tests rays, bounds and picked pixels through hearth.h against the images of frames.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "runtime/c/hearth.hpp"
#include "runtime/pack/page_graph.h"
#include "tests/runtime/c/c_fixture.h"
#include "tests/runtime/gpu/deformed_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

namespace hearth::test
{

namespace
{

using testing::HasSubstr;

/// Pixels whose center lies on an edge to within the rounding of the rasterizer.
constexpr size_t kMaxEdgePixels = 8;

/// The fixture's pack, and queries of it.
class CQueriesTest : public CApiTest
{
protected:
    void SetUp() override
    {
        CApiTest::SetUp();
        const hearth_queries_options options = HEARTH_QUERIES_OPTIONS_INIT;
        ASSERT_EQ(hearth_queries_create(pack_, &options, &handle_, message_, sizeof(message_)), HEARTH_OK)
            << message_;
        queries_ = Queries(handle_);
    }
    void TearDown() override
    {
        queries_.reset();
        CApiTest::TearDown();
    }

    /// Cast a ray through the center of each pixel of the fixture's images.
    std::vector<hearth_hit> castPixels(const hearth_frame& frame, const hearth_cast& cast)
    {
        std::vector<hearth_ray> rays(kWidth * kHeight);
        for (uint32_t i = 0; i < rays.size(); ++i)
            EXPECT_EQ(hearth_frame_get_ray(&frame, kWidth, kHeight, static_cast<float>(i % kWidth) + 0.5f,
                                           static_cast<float>(i / kWidth) + 0.5f, &rays[i], nullptr, 0),
                      HEARTH_OK);
        std::vector<hearth_hit> hits(rays.size());
        EXPECT_EQ(
            queries_.castRays(rays.data(), static_cast<uint32_t>(rays.size()), &cast, hits.data(), &text_),
            HEARTH_OK)
            << text_;
        return hits;
    }

    /// Draw as drawInC, and return the picks of all pixels.
    std::vector<hearth_pick> drawPicks(const hearth_frame& frame,
                                       const hearth_scene_options& scene = HEARTH_SCENE_OPTIONS_INIT,
                                       uint32_t targets_flags = 0)
    {
        std::vector<hearth_pick> picks(kWidth * kHeight);
        color_.assign(picks.size(), 0);
        visibility_.assign(picks.size(), 0);
        c_image image{};
        image.scene = scene;
        image.frame = frame;
        image.width = kWidth;
        image.height = kHeight;
        image.in_parts = in_parts_ ? 1 : 0;
        image.targets_flags = targets_flags;
        image.color = color_.data();
        image.visibility = visibility_.data();
        image.picks = picks.data();
        EXPECT_EQ(c_caller_draw(caller_, renderer_, pack_, &image), HEARTH_OK)
            << hearth_last_error(renderer_);
        return picks;
    }

    /// Compare the picked points of all pixels with hits of rays.
    void expectPickedPoints(const hearth_frame& frame)
    {
        const std::vector<hearth_pick> picks = drawPicks(frame);
        hearth_cast cast = HEARTH_CAST_INIT;
        cast.flags = HEARTH_CAST_FRONT_SIDES;
        const std::vector<hearth_hit> hits = castPixels(frame, cast);
        size_t same = 0, apart = 0, covered = 0;
        for (uint32_t i = 0; i < picks.size(); ++i)
        {
            hearth_hit point{};
            ASSERT_EQ(
                queries_.findPick(frame, kWidth, kHeight, i % kWidth, i / kWidth, picks[i], point, &text_),
                HEARTH_OK)
                << text_;
            ASSERT_EQ(point.instance, picks[i].instance);
            if (point.instance == UINT32_MAX)
                continue;
            ++covered;
            same += point.cluster == hits[i].cluster && point.triangle == hits[i].triangle;
            EXPECT_EQ(point.cluster, picks[i].cluster);
            // edges are rounded to 1/256 of a pixel: a neighbour of the triangle that the ray hits
            apart += !(std::abs(point.t - hits[i].t) < 1e-2f);
            EXPECT_GE(std::min({point.weights[0], point.weights[1], 1 - point.weights[0] - point.weights[1]}),
                      -1e-5f);
        }
        EXPECT_GT(covered, picks.size() / 8);
        EXPECT_GT(same, covered - covered / 20);
        EXPECT_LE(apart, kMaxEdgePixels);
    }

    hearth_queries* handle_ = nullptr;
    Queries queries_;
    std::string text_;
};

hearth_frame sourceFrame()
{
    hearth_frame frame = makeFrame();
    frame.error_pixels = 0;
    return frame;
}

hearth_frame parallelFrame()
{
    hearth_frame frame = sourceFrame();
    frame.camera.y_fov_rad = 0;
    frame.half_height = 3;
    frame.z_far = 20;
    return frame;
}

} // namespace

TEST_F(CQueriesTest, raysHitWhatPixelsShow)
{
    hearth_move move{0, {{1, 0, 0, 0.5f}, {0, 1, 0, 0.25f}, {0, 0, 1, 0}}};
    hearth_cast cast = HEARTH_CAST_INIT;
    cast.flags = HEARTH_CAST_FRONT_SIDES;
    for (const auto& [lens, moves] : {std::pair{sourceFrame(), false},
                                      {parallelFrame(), false},
                                      {sourceFrame(), true},
                                      {parallelFrame(), true}})
    {
        hearth_frame frame = lens;
        frame.moves = &move;
        frame.move_count = moves ? 1 : 0;
        ASSERT_EQ(queries_.place(frame.moves, frame.move_count, nullptr, 0, &text_), HEARTH_OK) << text_;
        frame.shift[0] = moves ? 0.25f : 0;
        frame.shift[1] = moves ? -0.125f : 0;
        (void)drawInC(frame);
        const std::vector<hearth_hit> hits = castPixels(frame, cast);
        size_t different = 0, covered = 0;
        for (size_t i = 0; i < hits.size(); ++i)
        {
            const bool is_sky = visibility_[i] == 0xFFFFFFFFu, misses = hits[i].instance == UINT32_MAX;
            different += is_sky != misses;
            covered += !misses;
            EXPECT_TRUE(misses || hits[i].t > frame.camera.z_near);
        }
        EXPECT_LE(different, kMaxEdgePixels);
        EXPECT_GT(covered, hits.size() / 8);
        EXPECT_LT(covered, hits.size());
    }
}

TEST_F(CQueriesTest, keptDepthIsThatOfRays)
{
    for (const uint32_t way : {HEARTH_FRAME_MERGED, HEARTH_FRAME_SEPARATE, HEARTH_FRAME_ONE_SET})
        for (const uint32_t occlusion : {HEARTH_OCCLUSION_TWO_PHASE, HEARTH_OCCLUSION_LAST_FRAME})
            for (const bool in_parts : {false, true})
            {
                const bool is_parallel = way == HEARTH_FRAME_MERGED && in_parts;
                const hearth_frame frame = is_parallel ? parallelFrame() : sourceFrame();
                hearth_renderer_description description = c_caller_description(caller_);
                description.features = HEARTH_FEATURE_DEPTH;
                description.frame_way = way;
                recreateRenderer(description);
                std::vector<float> depth(kWidth * kHeight);
                c_image image{};
                image.scene = HEARTH_SCENE_OPTIONS_INIT;
                image.frame = frame;
                image.frame.occlusion = occlusion;
                image.width = kWidth;
                image.height = kHeight;
                image.in_parts = in_parts ? 1 : 0;
                color_.assign(depth.size(), 0);
                visibility_.assign(depth.size(), 0);
                image.color = color_.data();
                image.visibility = visibility_.data();
                image.depth = depth.data();
                ASSERT_EQ(c_caller_draw(caller_, renderer_, pack_, &image), HEARTH_OK)
                    << hearth_last_error(renderer_);
                const std::vector<hearth_hit> hits = castPixels(frame, HEARTH_CAST_INIT);
                size_t different = 0, covered = 0;
                for (size_t i = 0; i < hits.size(); ++i)
                {
                    const bool misses = hits[i].instance == UINT32_MAX;
                    const float range = frame.z_far - frame.camera.z_near;
                    const float expected = misses        ? 0
                                           : is_parallel ? (frame.z_far - hits[i].t) / range
                                                         : frame.camera.z_near / hits[i].t;
                    different += std::abs(depth[i] - expected) > 1e-3f * expected;
                    covered += !misses;
                }
                EXPECT_LE(different, 2 * kMaxEdgePixels);
                EXPECT_GT(covered, hits.size() / 8);
            }
}

TEST_F(CQueriesTest, picksAreTheTrianglesOfTheVisibilityBuffer)
{
    hearth_frame frame = makeFrame();
    const auto seen = drawInCpp({}).seen();
    const auto expectSeen = [&](const std::vector<hearth_pick>& picks, const char* way)
    {
        size_t different = 0, sky = 0;
        for (size_t i = 0; i < picks.size(); ++i)
        {
            const bool is_sky = visibility_[i] == 0xFFFFFFFFu;
            sky += is_sky;
            different += is_sky
                             ? picks[i].instance != UINT32_MAX
                             : std::array{picks[i].instance, picks[i].cluster, picks[i].triangle} != seen[i];
        }
        EXPECT_EQ(different, 0u) << way;
        EXPECT_GT(sky, picks.size() / 8) << way;
        EXPECT_LT(sky, picks.size() - picks.size() / 8) << way;
    };
    for (const uint32_t way : {HEARTH_FRAME_MERGED, HEARTH_FRAME_SEPARATE, HEARTH_FRAME_ONE_SET})
    {
        hearth_renderer_description description = c_caller_description(caller_);
        description.frame_way = way;
        recreateRenderer(description);
        expectSeen(drawPicks(frame), "whole");
    }
    in_parts_ = true;
    expectSeen(drawPicks(frame, HEARTH_SCENE_OPTIONS_INIT, HEARTH_TARGETS_SPLIT), "in parts");
}

TEST_F(CQueriesTest, allLightMethodsKeepWhatPicksRead)
{
    hearth_renderer_description description = c_caller_description(caller_);
    description.features = HEARTH_FEATURE_DEFERRED;
    recreateRenderer(description);
    hearth_frame frame = makeFrame();
    const auto seen = drawInCpp({}).seen();
    constexpr std::pair<uint32_t, uint32_t> kMethods[] = {
        {HEARTH_LIGHTS_TILED_FORWARD, HEARTH_TARGETS_SPLIT},
        {HEARTH_LIGHTS_CLUSTERED_DEFERRED, HEARTH_TARGETS_SPLIT | HEARTH_TARGETS_DEFERRED},
        {HEARTH_LIGHTS_TILE_DEFERRED, HEARTH_TARGETS_TILE_DEFERRED},
        {HEARTH_LIGHTS_STACK, HEARTH_TARGETS_STACK},
        {HEARTH_LIGHTS_ENCODED_PREPASS, HEARTH_TARGETS_ENCODED_PREPASS}};
    for (const auto& [method, flags] : kMethods)
    {
        frame.light_method = method;
        const std::vector<hearth_pick> picks = drawPicks(frame, HEARTH_SCENE_OPTIONS_INIT, flags);
        size_t different = 0, covered = 0;
        for (size_t i = 0; i < picks.size(); ++i)
            if (picks[i].instance != UINT32_MAX)
            {
                ++covered;
                different += std::array{picks[i].instance, picks[i].cluster, picks[i].triangle} != seen[i];
            }
        EXPECT_EQ(different, 0u) << method;
        EXPECT_GT(covered, picks.size() / 8) << method;
    }
}

TEST_F(CQueriesTest, pickedPointsAreWhereRaysHit)
{
    for (const hearth_frame& frame : {sourceFrame(), parallelFrame()})
        expectPickedPoints(frame);
}

TEST_F(CQueriesTest, charactersArePickedInTheirPose)
{
    std::mt19937 random(73);
    DeformedScene test({.tentacles = 1, .blobs = 1, .rocks = 1, .rings = 12}, 33);
    queries_.reset();
    ASSERT_EQ(hearth_pack_close(pack_), HEARTH_OK);
    pack_ = nullptr;
    const AlignedBytes& bytes = test.bytes();
    ASSERT_EQ(hearth_pack_open_memory(bytes.span().data(), bytes.size(), "characters", &pack_, message_,
                                      sizeof(message_)),
              HEARTH_OK)
        << message_;
    const hearth_queries_options options = HEARTH_QUERIES_OPTIONS_INIT;
    ASSERT_EQ(hearth_queries_create(pack_, &options, &handle_, nullptr, 0), HEARTH_OK);
    queries_ = Queries(handle_);

    std::vector<TestPose> poses;
    std::vector<hearth_pose> c_poses;
    for (const uint32_t instance : test.deformedInstances())
        poses.push_back(poses.size() % 2 == 1 ? test.freePose(instance, random)
                                              : test.randomPose(instance, random));
    for (const TestPose& pose : poses)
        c_poses.push_back({pose.instance, static_cast<uint32_t>(pose.world_from_bind.size()),
                           reinterpret_cast<const hearth_transform*>(pose.world_from_bind.data()),
                           pose.morph_weights.data(), static_cast<uint32_t>(pose.morph_weights.size()),
                           pose.free ? 1u : 0u});
    hearth_frame frame = sourceFrame();
    frame.poses = c_poses.data();
    frame.pose_count = static_cast<uint32_t>(c_poses.size());
    const std::vector<hearth_pick> picks = drawPicks(frame);
    ASSERT_EQ(queries_.place(nullptr, 0, frame.poses, frame.pose_count, &text_), HEARTH_OK) << text_;
    hearth_cast cast = HEARTH_CAST_INIT;
    cast.flags = HEARTH_CAST_FRONT_SIDES;
    const std::vector<hearth_hit> hits = castPixels(frame, cast);
    size_t covered = 0, same = 0, apart = 0;
    std::set<uint32_t> seen;
    for (uint32_t i = 0; i < picks.size(); ++i)
    {
        hearth_hit point{};
        ASSERT_EQ(queries_.findPick(frame, kWidth, kHeight, i % kWidth, i / kWidth, picks[i], point),
                  HEARTH_OK);
        if (point.instance == UINT32_MAX)
            continue;
        ++covered;
        seen.insert(point.instance);
        same += point.instance == hits[i].instance && point.cluster == hits[i].cluster &&
                point.triangle == hits[i].triangle;
        apart += !(std::abs(point.t - hits[i].t) < 1e-2f);
    }
    EXPECT_GT(covered, picks.size() / 32);
    EXPECT_GT(seen.size(), poses.size() / 2) << "characters are in view";
    EXPECT_GT(same, covered - covered / 10);
    EXPECT_LE(apart, kMaxEdgePixels);
}

TEST_F(CQueriesTest, motionVectorsLeadToWhereQueriesFindPoints)
{
    hearth_frame before = sourceFrame(), frame = before;
    hearth_move rest{0, {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}, move = rest;
    move.world_from_object[0][3] = 0.125f;
    before.moves = &rest;
    frame.moves = &move;
    before.move_count = frame.move_count = 1;
    frame.camera.position[1] += 0.25f; // turns and rises
    frame.shift[0] = 0.01f;
    std::vector<hearth_pick> picks(kWidth * kHeight);
    std::vector<uint32_t> motion(picks.size());
    color_.assign(picks.size(), 0);
    visibility_.assign(picks.size(), 0);
    c_image image{};
    image.scene = HEARTH_SCENE_OPTIONS_INIT;
    image.scene.flags = HEARTH_SCENE_MOTION;
    image.frame = frame;
    image.before = &before;
    image.width = kWidth;
    image.height = kHeight;
    image.targets_flags = HEARTH_TARGETS_MOTION;
    image.color = color_.data();
    image.visibility = visibility_.data();
    image.picks = picks.data();
    image.motion = motion.data();
    ASSERT_EQ(c_caller_draw(caller_, renderer_, pack_, &image), HEARTH_OK) << hearth_last_error(renderer_);

    ASSERT_EQ(queries_.place(frame.moves, 1, nullptr, 0, &text_), HEARTH_OK) << text_;
    size_t moved = 0, still = 0, wrong = 0;
    for (uint32_t i = 0; i < picks.size(); ++i)
    {
        hearth_hit hit{};
        const uint32_t x = i % kWidth, y = i / kWidth;
        ASSERT_EQ(queries_.findPick(frame, kWidth, kHeight, x, y, picks[i], hit), HEARTH_OK);
        if (hit.instance == UINT32_MAX)
            continue;
        // the ray of the frame before, through the place to which the vector leads from the pixel less its
        // frame's shift, passes where the point was
        const float to_x = static_cast<float>(x) + 0.5f - 0.01f * kWidth / 2;
        hearth_ray ray{};
        ASSERT_EQ(hearth_frame_get_ray(&before, kWidth, kHeight,
                                       to_x + floatFromHalf(static_cast<uint16_t>(motion[i] & 0xFFFFu)),
                                       static_cast<float>(y) + 0.5f +
                                           floatFromHalf(static_cast<uint16_t>(motion[i] >> 16)),
                                       &ray, nullptr, 0),
                  HEARTH_OK);
        double offset[3], along = 0, square = 0, apart = 0;
        for (int axis = 0; axis < 3; ++axis)
        {
            const float shift = hit.instance == 0 && axis == 0 ? 0.125f : 0;
            offset[axis] = double{hit.position[axis]} - double{shift} - double{ray.origin[axis]};
            along += offset[axis] * double{ray.direction[axis]};
            square += double{ray.direction[axis]} * double{ray.direction[axis]};
        }
        for (int axis = 0; axis < 3; ++axis)
            apart += std::pow(offset[axis] - along / square * double{ray.direction[axis]}, 2);
        ++(hit.instance == 0 ? moved : still);
        // a pixel at a distance of a metre is 8 mm wide
        wrong += std::sqrt(apart) > 0.0008 * along / std::sqrt(square) ? 1 : 0;
    }
    EXPECT_GT(moved, 20u);
    EXPECT_GT(still, picks.size() / 8);
    EXPECT_LE(wrong, kMaxEdgePixels);
}

TEST_F(CQueriesTest, motionVectorsThatCannotBeAreRefused)
{
    hearth_targets_description description = HEARTH_TARGETS_DESCRIPTION_INIT;
    description.width = description.height = 64;
    hearth_targets *without = nullptr, *targets = nullptr;
    ASSERT_EQ(hearth_targets_create(renderer_, &description, &without), HEARTH_OK);
    description.flags = HEARTH_TARGETS_MOTION;
    ASSERT_EQ(hearth_targets_create(renderer_, &description, &targets), HEARTH_OK);
    hearth_targets_info info = HEARTH_TARGETS_INFO_INIT;
    ASSERT_EQ(hearth_targets_get_info(without, &info), HEARTH_OK);
    EXPECT_EQ(info.motion.image, VkImage{VK_NULL_HANDLE});
    ASSERT_EQ(hearth_targets_get_info(targets, &info), HEARTH_OK);
    EXPECT_NE(info.motion.image, VkImage{VK_NULL_HANDLE});
    EXPECT_NE(info.visibility.image, VkImage{VK_NULL_HANDLE}) << "is implied";
    EXPECT_EQ(info.motion.format, VK_FORMAT_R16G16_SFLOAT);
    hearth_scene *plain = nullptr, *scene = nullptr;
    hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    const VkCommandBuffer commands = c_caller_begin(caller_);
    ASSERT_EQ(hearth_scene_upload(renderer_, pack_, commands, &options, &plain), HEARTH_OK);
    options.flags = HEARTH_SCENE_MOTION;
    ASSERT_EQ(hearth_scene_upload(renderer_, pack_, commands, &options, &scene), HEARTH_OK);
    const hearth_frame frame = makeFrame();
    const auto refused = [&](hearth_scene* of, hearth_targets* into)
    {
        EXPECT_EQ(hearth_record_motion(of, into, commands), HEARTH_ERROR_USAGE);
        return std::string(hearth_last_error(renderer_));
    };
    EXPECT_THAT(refused(plain, targets), HasSubstr("HEARTH_SCENE_MOTION"));
    EXPECT_THAT(refused(scene, without), HasSubstr("HEARTH_TARGETS_MOTION"));
    EXPECT_THAT(refused(scene, nullptr), HasSubstr("NULL"));
    EXPECT_THAT(refused(scene, targets), HasSubstr("last frame"));
    ASSERT_EQ(hearth_record_frame(scene, targets, commands, &frame), HEARTH_OK);
    ASSERT_EQ(hearth_record_frame(scene, without, commands, &frame), HEARTH_OK);
    EXPECT_THAT(refused(scene, targets), HasSubstr("last frame"));
    ASSERT_EQ(hearth_record_frame(scene, targets, commands, &frame), HEARTH_OK);
    EXPECT_EQ(hearth_record_motion(scene, targets, commands), HEARTH_OK);
    ASSERT_EQ(c_caller_submit(caller_), VK_SUCCESS);
    EXPECT_EQ(hearth_scene_destroy(plain), HEARTH_OK);
    EXPECT_EQ(hearth_scene_destroy(scene), HEARTH_OK);
    EXPECT_EQ(hearth_targets_destroy(without), HEARTH_OK);
    EXPECT_EQ(hearth_targets_destroy(targets), HEARTH_OK);
}

TEST_F(CQueriesTest, framesAreFilteredThroughTheApi)
{
    hearth_targets_description description = HEARTH_TARGETS_DESCRIPTION_INIT;
    description.width = 64;
    description.height = 48;
    description.flags = HEARTH_TARGETS_ANTI_ALIASING;
    hearth_targets *targets = nullptr, *without = nullptr;
    ASSERT_EQ(hearth_targets_create(renderer_, &description, &targets), HEARTH_OK);
    description.flags = HEARTH_TARGETS_MOTION;
    ASSERT_EQ(hearth_targets_create(renderer_, &description, &without), HEARTH_OK);
    hearth_targets_info info = HEARTH_TARGETS_INFO_INIT;
    ASSERT_EQ(hearth_targets_get_info(without, &info), HEARTH_OK);
    EXPECT_EQ(info.filtered.image, VkImage{VK_NULL_HANDLE});
    ASSERT_EQ(hearth_targets_get_info(targets, &info), HEARTH_OK);
    EXPECT_EQ(info.filtered.format, VK_FORMAT_R8G8B8A8_SRGB);
    EXPECT_NE(info.motion.image, VkImage{VK_NULL_HANDLE}) << "is implied";
    hearth_scene* scene = nullptr;
    hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    options.flags = HEARTH_SCENE_MOTION;
    VkCommandBuffer commands = c_caller_begin(caller_);
    ASSERT_EQ(hearth_scene_upload(renderer_, pack_, commands, &options, &scene), HEARTH_OK);
    const auto refused = [&](hearth_targets* into, uint32_t reset)
    {
        EXPECT_EQ(hearth_record_anti_aliasing(scene, into, commands, reset), HEARTH_ERROR_USAGE);
        return std::string(hearth_last_error(renderer_));
    };
    hearth_frame frame = makeFrame();
    for (uint32_t number = 0; number < 3; ++number)
    {
        ASSERT_EQ(hearth_get_jitter(number, 64, 48, &frame.shift[0], &frame.shift[1], nullptr, 0), HEARTH_OK);
        EXPECT_LE(std::abs(frame.shift[0]), 1.0f / 64);
        EXPECT_LE(std::abs(frame.shift[1]), 1.0f / 48);
        ASSERT_EQ(hearth_record_frame(scene, targets, commands, &frame), HEARTH_OK);
        EXPECT_THAT(refused(targets, 0), HasSubstr("hearth_record_motion has not been recorded"));
        ASSERT_EQ(hearth_record_motion(scene, targets, commands), HEARTH_OK);
        EXPECT_EQ(hearth_record_anti_aliasing(scene, targets, commands, number == 0 ? 1 : 0), HEARTH_OK);
    }
    EXPECT_THAT(refused(without, 0), HasSubstr("HEARTH_TARGETS_ANTI_ALIASING"));
    EXPECT_THAT(refused(targets, 2), HasSubstr("reset"));
    EXPECT_THAT(refused(nullptr, 0), HasSubstr("NULL"));
    EXPECT_EQ(hearth_get_jitter(0, 0, 48, &frame.shift[0], &frame.shift[1], message_, sizeof(message_)),
              HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("width or height is 0"));
    ASSERT_EQ(c_caller_submit(caller_), VK_SUCCESS);
    EXPECT_EQ(hearth_scene_destroy(scene), HEARTH_OK);
    EXPECT_EQ(hearth_targets_destroy(targets), HEARTH_OK);
    EXPECT_EQ(hearth_targets_destroy(without), HEARTH_OK);
}

TEST_F(CQueriesTest, picksThatCannotBeAreRefused)
{
    hearth_targets_description description = HEARTH_TARGETS_DESCRIPTION_INIT;
    description.width = description.height = 128;
    hearth_targets *without = nullptr, *targets = nullptr;
    ASSERT_EQ(hearth_targets_create(renderer_, &description, &without), HEARTH_OK);
    ASSERT_EQ(createTargets(renderer_, 128, 128, &targets), HEARTH_OK);
    hearth_scene* scene = nullptr;
    const hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    const VkCommandBuffer commands = c_caller_begin(caller_);
    ASSERT_EQ(hearth_scene_upload(renderer_, pack_, commands, &options, &scene), HEARTH_OK);
    const auto buffer = reinterpret_cast<VkBuffer>(uintptr_t{1}); // refused before it is used
    const auto refused = [&](hearth_targets* into, const hearth_pixels& pixels)
    {
        EXPECT_EQ(hearth_record_picks(scene, into, commands, &pixels, buffer, 0), HEARTH_ERROR_USAGE);
        return std::string(hearth_last_error(renderer_));
    };
    EXPECT_THAT(refused(without, {0, 0, 1, 1}),
                HasSubstr("HEARTH_TARGETS_KEEP_VISIBILITY: create them with it"));
    EXPECT_THAT(refused(targets, {0, 0, 1, 1}), HasSubstr("hearth_scene_prepare_picks"));
    ASSERT_EQ(hearth_scene_prepare_picks(scene), HEARTH_OK);
    ASSERT_EQ(hearth_scene_prepare_picks(scene), HEARTH_OK) << "again";
    EXPECT_THAT(refused(targets, {0, 0, 1, 1}), HasSubstr("no whole frame"));
    const hearth_frame frame = makeFrame();
    ASSERT_EQ(hearth_record_frame(scene, targets, commands, &frame), HEARTH_OK);
    EXPECT_THAT(refused(targets, {0, 0, 0, 1}), HasSubstr("0 pixels are not from 1 to 4096"));
    EXPECT_THAT(refused(targets, {0, 0, 128, 33}), HasSubstr("4224 pixels"));
    EXPECT_THAT(refused(targets, {100, 0, 29, 1}), HasSubstr("not all inside"));
    EXPECT_THAT(refused(targets, {0, 0xFFFFFFFFu, 1, 2}), HasSubstr("not all inside"));
    EXPECT_THAT(refused(nullptr, {0, 0, 1, 1}), HasSubstr("NULL"));
    ASSERT_EQ(c_caller_submit(caller_), VK_SUCCESS);
    hearth_hit hit{};
    const hearth_pick wrong{0, 0xFFFFFFu, 0, 0}, sky{UINT32_MAX, 0, 0, 0};
    EXPECT_EQ(queries_.findPick(frame, 128, 128, 3, 4, wrong, hit, &text_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(text_, HasSubstr("has no cluster"));
    EXPECT_EQ(queries_.findPick(frame, 128, 128, 3, 4, sky, hit), HEARTH_OK);
    EXPECT_EQ(hit.instance, UINT32_MAX);
    EXPECT_EQ(hearth_scene_prepare_picks(nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_scene_destroy(scene), HEARTH_OK);
    EXPECT_EQ(hearth_targets_destroy(targets), HEARTH_OK);
    EXPECT_EQ(hearth_targets_destroy(without), HEARTH_OK);
}

TEST_F(CQueriesTest, hitsNameRecordsOfThePack)
{
    hearth_ray ray{{0, 0, 9}, {0, 0, -1}, 0, INFINITY};
    hearth_hit hit{};
    ASSERT_EQ(queries_.castRay(ray, hit, nullptr, &text_), HEARTH_OK) << text_;
    ASSERT_NE(hit.instance, UINT32_MAX);
    hearth_pack_instance instance = HEARTH_PACK_INSTANCE_INIT;
    ASSERT_EQ(hearth_pack_get_instance(pack_, hit.instance, &instance, nullptr, 0), HEARTH_OK);
    EXPECT_EQ(hit.node, instance.node);
    EXPECT_EQ(hit.mesh, instance.mesh);
    EXPECT_LT(hit.material, 2u);
    EXPECT_NEAR(hit.position[2], 9 - hit.t, 1e-5f);
    EXPECT_NEAR(std::hypot(hit.normal[0], hit.normal[1], hit.normal[2]), 1, 1e-6f);
    hearth_box box{};
    ASSERT_EQ(queries_.getBounds(hit.instance, 1, box), HEARTH_OK);
    for (int axis = 0; axis < 3; ++axis)
    {
        EXPECT_GE(hit.position[axis], box.min[axis]);
        EXPECT_LE(hit.position[axis], box.max[axis]);
    }

    // a filter that wants another instance
    struct Filter
    {
        uint32_t refused;
        uint32_t calls;
        static int accept(void* user, const hearth_hit* found)
        {
            auto& filter = *static_cast<Filter*>(user);
            ++filter.calls;
            return found->instance != filter.refused ? 1 : 0;
        }
    } filter{hit.instance, 0};
    hearth_cast cast = HEARTH_CAST_INIT;
    cast.accept = Filter::accept;
    cast.user = &filter;
    hearth_hit other{};
    ASSERT_EQ(queries_.castRay(ray, other, &cast), HEARTH_OK);
    EXPECT_NE(other.instance, hit.instance);
    EXPECT_GT(filter.calls, 0u);

    ray.t_max = hit.t * 0.99f;
    ASSERT_EQ(queries_.castRay(ray, other), HEARTH_OK);
    EXPECT_EQ(other.instance, UINT32_MAX);
    EXPECT_EQ(other.t, 0);
}

TEST_F(CQueriesTest, raysHitTheLevelThatAStreamedSceneHolds)
{
    Reader reader{pack_, kInvalidIndex, {}};
    hearth_scene_options options = streamedBy(reader);
    hearth_scene* scene = nullptr;
    ASSERT_EQ(hearth_scene_upload(renderer_, pack_, c_caller_begin(caller_), &options, &scene), HEARTH_OK)
        << hearth_last_error(renderer_);
    ASSERT_EQ(c_caller_submit(caller_), VK_SUCCESS);
    // nothing was asked for yet: the coarsest levels are there
    hearth_cast source = HEARTH_CAST_INIT, held = HEARTH_CAST_INIT;
    held.scene = scene;
    const hearth_frame frame = sourceFrame();
    const std::vector<hearth_hit> fine = castPixels(frame, source), coarse = castPixels(frame, held);
    size_t clusters = 0;
    for (size_t i = 0; i < fine.size(); ++i)
        clusters += fine[i].cluster != coarse[i].cluster;
    EXPECT_GT(clusters, fine.size() / 8);
    const pack::PageGraph graph = pack::PageGraph::of(*view_);
    for (const hearth_hit& hit : fine)
        EXPECT_TRUE(hit.instance == UINT32_MAX || view_->clusters()[hit.cluster].level == 0);
    for (const hearth_hit& hit : coarse)
        EXPECT_TRUE(hit.instance == UINT32_MAX || graph.isPinned(view_->clusters()[hit.cluster].page));
    EXPECT_EQ(hearth_scene_destroy(scene), HEARTH_OK);
}

TEST_F(CQueriesTest, whatCannotBeIsRefused)
{
    hearth_ray ray{{0, 0, 9}, {0, 0, -1}, 0, 100};
    hearth_hit hit{};
    const auto refuses = [&](const hearth_ray& bad, const char* text)
    {
        EXPECT_EQ(queries_.castRay(bad, hit, nullptr, &text_), HEARTH_ERROR_USAGE);
        EXPECT_THAT(text_, HasSubstr(text));
    };
    refuses({{0, 0, 9}, {0, 0, 0}, 0, 100}, "its direction is 0");
    refuses({{NAN, 0, 9}, {0, 0, 1}, 0, 100}, "not finite");
    refuses({{0, 0, 9}, {0, 0, 1}, -1, 100}, "t_min of a ray is below 0");
    refuses({{0, 0, 9}, {0, 0, 1}, 2, 1}, "t_max below t_min");
    hearth_cast cast = HEARTH_CAST_INIT;
    cast.flags = 4;
    EXPECT_EQ(queries_.castRay(ray, hit, &cast, &text_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(text_, HasSubstr("flags of cast"));
    cast.struct_size = 3;
    EXPECT_EQ(queries_.castRay(ray, hit, &cast), HEARTH_ERROR_USAGE);
    EXPECT_EQ(queries_.castRays(nullptr, 1, nullptr, &hit), HEARTH_ERROR_USAGE);
    EXPECT_EQ(queries_.castRays(nullptr, 0, nullptr, nullptr), HEARTH_OK);

    hearth_box box{}, before{};
    EXPECT_EQ(queries_.getBounds(5, 2, box, &text_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(text_, HasSubstr("the pack has 6"));
    ASSERT_EQ(queries_.getBounds(0, 6, before), HEARTH_OK);
    hearth_move moves[2] = {{0, {{1, 0, 0, 90}, {0, 1, 0, 0}, {0, 0, 1, 0}}}, {6, {{1}, {0, 1}, {0, 0, 1}}}};
    EXPECT_EQ(queries_.place(moves, 2, nullptr, 0, &text_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(text_, HasSubstr("instance 6"));
    ASSERT_EQ(queries_.getBounds(0, 6, box), HEARTH_OK);
    EXPECT_EQ(box.max[0], before.max[0]) << "an error moves nothing";
    const hearth_pose pose{0, 0, nullptr, nullptr, 0, 0};
    EXPECT_EQ(queries_.place(nullptr, 0, &pose, 1, &text_), HEARTH_ERROR_USAGE);
    EXPECT_THAT(text_, HasSubstr("it has no joints"));
    EXPECT_EQ(queries_.place(nullptr, 1, nullptr, 0), HEARTH_ERROR_USAGE);

    hearth_frame frame = makeFrame();
    EXPECT_EQ(hearth_frame_get_ray(&frame, 0, 1, 0, 0, &ray, nullptr, 0), HEARTH_ERROR_USAGE);
    frame.camera.y_fov_rad = 4;
    EXPECT_EQ(hearth_frame_get_ray(&frame, 1, 1, 0, 0, &ray, message_, sizeof(message_)), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("y_fov_rad"));
    EXPECT_EQ(hearth_queries_create(pack_, nullptr, &handle_, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_close(pack_), HEARTH_ERROR_IN_USE);
    EXPECT_THAT(hearth_pack_last_error(pack_), HasSubstr("1 queries object is alive"));
}

TEST_F(CQueriesTest, damagedPagesAreAnError)
{
    PackModel model = test_.model();
    for (const formats::PageRecord& page : model.pages)
        model.page_bytes[static_cast<size_t>(page.offset) + page.stored_size / 2] ^= std::byte{0x55};
    const AlignedBytes damaged = model.bytes();
    Pack pack;
    ASSERT_EQ(Pack::openMemory(damaged.span().data(), damaged.size(), "damaged", pack, &text_), HEARTH_OK)
        << text_;
    Queries queries;
    ASSERT_EQ(Queries::create(pack, HEARTH_QUERIES_OPTIONS_INIT, queries), HEARTH_OK);
    const hearth_ray ray{{0, 0, 9}, {0, 0, -1}, 0, 100};
    hearth_hit hit{};
    EXPECT_EQ(queries.castRay(ray, hit, nullptr, &text_), HEARTH_ERROR_FILE_MALFORMED);
    EXPECT_THAT(text_, HasSubstr("damaged"));
}

} // namespace hearth::test
