// Tests deformed meshes: culling changes no pixel in any pose; vertices are where glTF puts them; and the
// place of skinning does not matter.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/culling/cpu_rasteriser.h"
#include "tests/runtime/gpu/deformed_scene.h"
#include "tests/support/gpu_fixture.h"

#include <cmath>

namespace hearth::test
{

namespace
{

using namespace shared;

class DeformationTest : public GpuTest
{
protected:
    DeformationHeader readHeader(const gpu::Scene& scene)
    {
        return read<DeformationHeader>(scene.deformation->table.copy(scene.tables->frame), 1)[0];
    }
};

/// Scratch block of a slot; nullopt if it has none.
std::optional<uint32_t> findBlock(const DeformationHeader& header, uint32_t slot)
{
    const bool early = slot >= header.early_first && slot < header.early_end;
    const uint32_t block = early ? slot - header.early_first
                                 : header.early_end - header.early_first + (slot - header.late_first);
    return block < header.block_count ? std::optional(block) : std::nullopt;
}

Double3 widenAt(const std::vector<float>& words, size_t word)
{
    return widen(Float3{words[word], words[word + 1], words[word + 2]});
}

/// Last pose of each posed instance.
using Poses = std::map<uint32_t, TestPose>;

void keep(const std::vector<TestPose>& poses, Poses& kept)
{
    for (const TestPose& pose : poses)
        kept[pose.instance] = pose;
}

/// Pose all deformed instances once.
std::vector<TestPose> poseAll(const DeformedScene& test, std::mt19937& random)
{
    std::vector<TestPose> poses;
    for (const uint32_t instance : test.deformedInstances())
        poses.push_back(test.randomPose(instance, random));
    return poses;
}

} // namespace

TEST_F(DeformationTest, cullingIsLosslessInEveryPose)
{
    std::mt19937 random(51);
    const DeformedScene test({}, 1);
    const auto scene = upload(test.pack());
    gpu::FrameTargets targets = makeTargets(96, 72);
    size_t drawn = 0, late = 0, all = 0;
    Camera camera;
    for (int frame = 0; frame < 300; ++frame)
    {
        if (frame % 10 == 0)
            camera = frame % 30 == 20 ? randomOrthographicCamera(random, 4) : randomCamera(random, 4);
        const auto poses = test.randomPoses(random);
        const auto views = makeViews(poses);
        const DrawOptions options{
            .width = 96, .height = 72, .error_pixels = frame % 2 == 0 ? 1.0f : 6.0f, .poses = views};
        const Image some = draw(*scene, targets, camera, options);
        DrawOptions everything = options;
        everything.flags = 0;
        everything.poses = {};
        const Image whole = draw(*scene, camera, everything);
        ASSERT_EQ(some.seen(), whole.seen()) << "frame " << frame;
        ASSERT_EQ(some.color, whole.color) << "frame " << frame;
        drawn += some.list.slots.size();
        late += some.list.slots.size() - some.list.counters.early_clusters;
        all += whole.list.slots.size();
    }
    EXPECT_LT(drawn, all * 7 / 10);
    EXPECT_GT(late, 300u) << "a late phase that finds nothing is not tested";
}

TEST_F(DeformationTest, eachTestAloneIsLossless)
{
    std::mt19937 random(52);
    const DeformedScene test({}, 2);
    const auto scene = upload(test.pack());
    std::map<uint32_t, size_t> culled;
    for (int frame = 0; frame < 24; ++frame)
    {
        const auto poses = poseAll(test, random);
        const auto views = makeViews(poses);
        const Camera camera = frame % 4 == 3 ? randomOrthographicCamera(random, 4) : randomCamera(random, 4);
        DrawOptions options{.width = 96, .height = 72, .flags = 0, .poses = views};
        const Image whole = draw(*scene, camera, options);
        for (const uint32_t flag : {kCullInstances, kCullFrustum, kCullCone})
        {
            options.flags = flag;
            const Image some = draw(*scene, camera, options);
            ASSERT_EQ(some.seen(), whole.seen()) << "frame " << frame << ", test " << flag;
            culled[flag] += whole.list.slots.size() - some.list.slots.size();
        }
    }
    for (const uint32_t flag : {kCullInstances, kCullFrustum, kCullCone})
        EXPECT_GT(culled[flag], 50u) << "a test that culls nothing is not tested";
}

TEST_F(DeformationTest, freePosesAreNeverCulledWrongly)
{
    std::mt19937 random(53);
    const DeformedScene test({.limbs = 4, .tentacles = 3, .blobs = 3}, 3);
    const formats::PackView& pack = test.pack();
    const auto scene = upload(pack);
    gpu::FrameTargets targets = makeTargets(96, 72);
    size_t drawn = 0, all = 0, drawn_morphs = 0, all_morphs = 0;
    const auto countMorphs = [&](const Image& image)
    {
        return static_cast<size_t>(std::count_if(
            image.list.slots.begin(), image.list.slots.end(),
            [&](const auto& slot)
            { return pack.meshes()[pack.instances()[slot.instance].mesh].morph_target_count > 0; }));
    };
    Camera camera;
    for (int frame = 0; frame < 60; ++frame)
    {
        if (frame % 6 == 0)
            camera = randomCamera(random, 4);
        std::vector<TestPose> poses;
        for (const uint32_t instance : test.deformedInstances())
            poses.push_back(random() % 3 == 0 ? test.randomPose(instance, random)
                                              : test.freePose(instance, random));
        const auto views = makeViews(poses);
        const DrawOptions options{.width = 96, .height = 72, .error_pixels = 2, .poses = views};
        const Image some = draw(*scene, targets, camera, options);
        DrawOptions everything = options;
        everything.flags = 0;
        const Image whole = draw(*scene, camera, everything);
        ASSERT_EQ(some.seen(), whole.seen()) << "frame " << frame;
        drawn += some.list.slots.size();
        all += whole.list.slots.size();
        drawn_morphs += countMorphs(some);
        all_morphs += countMorphs(whole);
    }
    EXPECT_LT(drawn, all * 9 / 10);
    EXPECT_LT(drawn_morphs, all_morphs * 9 / 10) << "weights of 2 and more leave bounds";
}

TEST_F(DeformationTest, skinnedVerticesAreWhereGltfSays)
{
    std::mt19937 random(54);
    const DeformedScene test({}, 4);
    const auto scene = upload(test.pack());
    double farthest = 0, most_turned = 0;
    size_t vertices = 0;
    for (int frame = 0; frame < 6; ++frame)
    {
        const auto poses = poseAll(test, random);
        const auto views = makeViews(poses);
        Poses posed;
        keep(poses, posed);
        const Image image =
            draw(*scene, randomCamera(random, 3), {.error_pixels = 0.25f, .flags = 0, .poses = views});
        const DeformationHeader header = readHeader(*scene);
        const auto words = read<float>(scene->deformation->table.copy(scene->tables->frame),
                                       header.scratch_word + size_t{header.block_words} * header.block_count);
        for (uint32_t slot = header.early_first; slot < header.early_end; ++slot)
        {
            const auto block = findBlock(header, slot);
            ASSERT_TRUE(block);
            const VisibleCluster& visible = image.list.slots[slot];
            const TestPose& pose = posed.at(visible.instance);
            const formats::ClusterGeometry geometry = test.geometry().cluster(visible.cluster);
            const auto* deformed = gpu::findDeformed(scene->deformation->layout, visible.instance);
            const auto anchor = narrowed(pose.world_from_bind[deformed->anchor]);
            const Double3 origin{anchor->m[0][3], anchor->m[1][3], anchor->m[2][3]};
            const size_t first = header.scratch_word + size_t{*block} * header.block_words;
            for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
            {
                const PosedVertex expected = posedVertex(geometry, v, pose);
                const size_t count = geometry.vertexCount();
                const Double3 position = widenAt(words, first + 3 * v) + origin;
                const Double3 normal = widenAt(words, first + 3 * (count + v));
                const Double3 tangent = widenAt(words, first + 3 * (2 * count + v));
                farthest = std::max(farthest, length(position - expected.position));
                most_turned = std::max(
                    {most_turned, length(normal - expected.normal), length(tangent - expected.tangent)});
                ++vertices;
            }
        }
    }
    // the limbs are two metres long and scaled by at most 1.6
    EXPECT_LT(farthest, 1e-5 * 2);
    EXPECT_LT(most_turned, 1e-4);
    EXPECT_GT(vertices, 10000u);
    std::printf("%zu skinned vertices: position off by at most %.2g m, normal and tangent by %.2g\n",
                vertices, farthest, most_turned);
}

TEST_F(DeformationTest, theSizeOfTheScratchDoesNotShow)
{
    std::mt19937 random(55);
    const DeformedScene test({.rocks = 8}, 5);
    const auto whole = upload(test.pack());
    const uint64_t block_bytes = readHeader(*whole).block_words * 4;
    const auto none = upload(test.pack(), {.deformation = {.scratch_bytes = 0}});
    const auto few = upload(test.pack(), {.deformation = {.scratch_bytes = 6 * block_bytes}});
    gpu::FrameTargets targets[] = {makeTargets(160, 120), makeTargets(160, 120), makeTargets(160, 120)};
    Camera camera;
    size_t beyond = 0;
    for (int frame = 0; frame < 24; ++frame)
    {
        if (frame % 4 == 0)
            camera = randomCamera(random, 4);
        const auto poses = test.randomPoses(random);
        const auto views = makeViews(poses);
        const DrawOptions options{.error_pixels = 0.5f, .poses = views};
        const Image expected = draw(*whole, targets[0], camera, options);
        const Image direct = draw(*none, targets[1], camera, options);
        const Image mixed = draw(*few, targets[2], camera, options);
        ASSERT_EQ(readHeader(*none).group_count, 0u);
        ASSERT_EQ(direct.visibility, expected.visibility) << "frame " << frame;
        ASSERT_EQ(direct.color, expected.color) << "frame " << frame;
        ASSERT_EQ(mixed.visibility, expected.visibility) << "frame " << frame;
        ASSERT_EQ(mixed.color, expected.color) << "frame " << frame;
        const DeformationHeader header = readHeader(*few);
        beyond += deformedSlots(header) > 6 ? 1u : 0u;
    }
    EXPECT_GT(beyond, 5u) << "a scratch that is never full is not tested";
}

TEST_F(DeformationTest, theImageIsTheCpuRasterisersOfThePosedTriangles)
{
    std::mt19937 random(56);
    const DeformedScene test({.rocks = 0}, 6);
    const auto scene = upload(test.pack());
    reference::RasterComparison sums;
    for (int frame = 0; frame < 8; ++frame)
    {
        const auto poses = poseAll(test, random);
        const auto views = makeViews(poses);
        Poses posed;
        keep(poses, posed);
        const DrawOptions options{.poses = views};
        const Camera camera = randomCamera(random, 3);
        const Image image = draw(*scene, camera, options);

        std::vector<formats::InstanceRecord> unmoved(test.pack().instances().begin(),
                                                     test.pack().instances().end());
        for (formats::InstanceRecord& instance : unmoved)
            instance.world_from_object = {};
        std::vector<reference::SceneTriangle> triangles;
        for (uint32_t slot = 0; slot < image.list.slots.size(); ++slot)
        {
            const VisibleCluster& visible = image.list.slots[slot];
            const formats::ClusterGeometry geometry = test.geometry().cluster(visible.cluster);
            for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
            {
                reference::SceneTriangle triangle{.corners = {},
                                                  .instance = visible.instance,
                                                  .material =
                                                      test.pack().clusters()[visible.cluster].material,
                                                  .id = slot << kTriangleBits | t};
                for (size_t corner = 0; corner < 3; ++corner)
                    triangle.corners[corner] =
                        narrow(posedVertex(geometry, geometry.triangle(t)[corner], posed.at(visible.instance))
                                   .position);
                triangles.push_back(triangle);
            }
        }
        const reference::RasterImage expected = reference::rasterise(
            triangles, {unmoved, test.pack().materials()}, makeView(*scene, camera, options));
        const auto comparison =
            reference::compareIds(expected, image.visibility, [](uint32_t a, uint32_t b) { return a == b; });
        EXPECT_EQ(comparison.coverage_unexcused, 0u) << "frame " << frame;
        sums.covered += comparison.covered;
        sums.pixels += comparison.pixels;
        sums.different_unexcused += comparison.different_unexcused;
    }
    EXPECT_GT(sums.covered, sums.pixels / 20);
    EXPECT_LE(static_cast<double>(sums.different_unexcused), 2e-5 * static_cast<double>(sums.pixels));
}

TEST_F(DeformationTest, farFromTheOriginNothingFallsApart)
{
    std::mt19937 random(57);
    const DeformedScene test({.rocks = 0}, 7);
    const auto scene = upload(test.pack());
    const Double3 offset{1048576, -524288, 2097152};
    for (int frame = 0; frame < 6; ++frame)
    {
        auto poses = poseAll(test, random);
        Camera camera = randomCamera(random, 3);
        // whole quarters of a metre, which floats represent far away
        for (TestPose& pose : poses)
        {
            const auto* deformed = gpu::findDeformed(scene->deformation->layout, pose.instance);
            const Affine3d anchor = pose.world_from_bind[deformed->anchor];
            for (Affine3d& joint : pose.world_from_bind)
                for (int row = 0; row < 3; ++row)
                    joint.m[row][3] += std::round(anchor.m[row][3] * 4) / 4 - anchor.m[row][3];
        }
        for (Float3* point : {&camera.position, &camera.target})
            *point = {std::round(point->x * 4) / 4, std::round(point->y * 4) / 4,
                      std::round(point->z * 4) / 4};
        camera.target += {0, 0, 1};
        const auto here = makeViews(poses);
        const Image expected = draw(*scene, camera, {.poses = here});
        for (TestPose& pose : poses)
            for (Affine3d& joint : pose.world_from_bind)
            {
                joint.m[0][3] += offset.x;
                joint.m[1][3] += offset.y;
                joint.m[2][3] += offset.z;
            }
        camera.position += narrow(offset);
        camera.target += narrow(offset);
        const auto there = makeViews(poses);
        const Image image = draw(*scene, camera, {.poses = there});
        EXPECT_EQ(image.seen(), expected.seen()) << "frame " << frame;
    }
}

TEST_F(DeformationTest, overdrawMayBePreparedBeforeTheScene)
{
    const DeformedScene test({.rocks = 0}, 10);
    auto made = gpu::Renderer::create(host().description());
    ASSERT_TRUE(made.ok() && (*made)->prepareOverdraw().ok());
    gpu::Renderer& early = **made;
    const DrawOptions options{.width = 96, .height = 72, .debug_view = kViewOverdraw};
    const Camera camera{.position = {0, 0, 8}, .target = {}};
    std::unique_ptr<gpu::Scene> scene;
    auto targets = early.createTargets({options.width, options.height}, {.keeps_visibility = true});
    ASSERT_TRUE(targets.ok());
    const auto run = [&](const auto& record) { ASSERT_TRUE(host().run(record).ok()); };
    run(
        [&](VkCommandBuffer commands) -> Status
        {
            HEARTH_ASSIGN_OR_RETURN(scene, early.upload(test.pack(), commands));
            return success();
        });
    scene->staging.reset();
    run(
        [&](VkCommandBuffer commands)
        {
            early.record(
                commands, *scene, *targets,
                {.view = makeView(*scene, camera, options), .shading = {.debug_view = options.debug_view}});
            return success();
        });
    const auto late = upload(test.pack());
    EXPECT_EQ(readImage(*scene, *targets).color, draw(*late, camera, options).color);
}

TEST_F(DeformationTest, whatAPoseCannotBeIsNamedAndLeftOut)
{
    std::mt19937 random(58);
    const DeformedScene test({.limbs = 2, .tentacles = 1, .blobs = 1, .rocks = 1}, 8);
    const auto scene = upload(test.pack());
    const uint32_t limb = test.deformedInstances()[0];
    const TestPose good = test.randomPose(limb, random);
    TestPose broken = test.randomPose(limb, random), short_one = good, rigid = good;
    broken.world_from_bind[3].m[1][2] = std::numeric_limits<double>::quiet_NaN();
    short_one.world_from_bind.pop_back();
    rigid.instance = 0;
    EXPECT_TRUE(gpu::checkPose(*scene, good.view()).ok());
    for (const TestPose* bad : {&broken, &short_one, &rigid})
        EXPECT_EQ(gpu::checkPose(*scene, bad->view()).error().issue, Issue::usage);
    EXPECT_EQ(gpu::moveInstance(*scene, limb, Affine3{}).error().issue, Issue::usage);

    const Camera camera{.position = {0, 1, 9}, .target = {0, 0, 0}};
    const gpu::InstancePose first[] = {good.view()};
    const Image expected = draw(*scene, camera, {.poses = first});
    const gpu::InstancePose bad[] = {broken.view(), short_one.view(), rigid.view()};
    EXPECT_EQ(draw(*scene, camera, {.poses = bad}).color, expected.color);
}

TEST_F(DeformationTest, castersAreDeformedAndMapsAreKept)
{
    std::mt19937 random(59);
    const DeformedScene test({}, 9);
    const gpu::SceneOptions options{.shadows = {.max_maps = 4, .texels = 256}};
    const auto scene = upload(test.pack(), options);
    const Camera camera{.position = {2, 4, 9}, .target = {0, 0, 0}};
    size_t kept = 0, moved = 0;
    for (int frame = 0; frame < 12; ++frame)
    {
        const auto poses = frame % 3 == 2 ? std::vector<TestPose>() : test.randomPoses(random);
        const auto views = makeViews(poses);
        const Image image = draw(*scene, camera, {.poses = views});
        const gpu::ShadowStatistics& statistics = scene->shadows->statistics();
        kept += frame % 3 == 2 && statistics.drawn_maps + statistics.moved_maps == 0 ? 1u : 0u;
        moved += statistics.moved_maps > 0 ? 1u : 0u;
        scene->shadows->forget();
        const Image fresh = draw(*scene, camera);
        ASSERT_EQ(image.color, fresh.color) << "frame " << frame;
    }
    EXPECT_GT(moved, 4u);
    EXPECT_EQ(kept, 4u) << "poses last: what has not changed is not drawn anew";
    EXPECT_EQ(scene->shadows->statistics().unshadowed_lights, 0u);
}

} // namespace hearth::test
