// Tests moving instances: drawn as if they had always been there, and never culled because of their previous
// place.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/pose_player.h"
#include "tests/runtime/gpu/animated_rocks.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <cstdlib>
#include <limits>

namespace hearth::test
{

namespace
{

using namespace shared;

constexpr uint32_t kRocks = 14;

/// Rocks at the given places, every third one mirrored.
formats::PackView buildRocks(TestScene& test, std::span<const Affine3> places)
{
    const uint32_t mesh =
        test.addMesh(withMaterial(shapes::rock(20, 0.3f), test.addMaterial(plainMaterial())));
    for (const Affine3& place : places)
        test.addInstance(mesh, place);
    return test.build();
}

Affine3 choosePlace(uint32_t rock, std::mt19937& random)
{
    Affine3 place = randomAffine(random, 4);
    if ((determinant(place) < 0) != (rock % 3 == 0))
        for (auto& row : place.m)
            row[0] = -row[0];
    return place;
}

std::vector<Affine3> randomPlaces(std::mt19937& random)
{
    std::vector<Affine3> places;
    for (uint32_t rock = 0; rock < kRocks; ++rock)
        places.push_back(choosePlace(rock, random));
    return places;
}

class MotionTest : public GpuTest
{
};

} // namespace

TEST_F(MotionTest, whatMovedIsDrawnAsIfItHadAlwaysBeenThere)
{
    std::mt19937 random(31);
    TestScene before_test, after_test;
    const auto before = randomPlaces(random), after = randomPlaces(random);
    const formats::PackView before_pack = buildRocks(before_test, before);
    const formats::PackView after_pack = buildRocks(after_test, after);
    const auto moving = upload(before_pack);
    const auto still = upload(after_pack);
    std::vector<gpu::InstanceMove> moves;
    for (uint32_t rock = 0; rock < kRocks; ++rock)
    {
        auto move = gpu::moveInstance(*moving, rock, after[rock]);
        ASSERT_TRUE(move.ok()) << formatMessage(move.error());
        moves.push_back(*move);
    }
    for (int i = 0; i < 4; ++i)
    {
        const Camera camera = randomCamera(random, 6);
        // only the first frame has the moves: they persist
        const Image moved = draw(*moving, camera,
                                 {.moves = i == 0 ? std::span<const gpu::InstanceMove>(moves)
                                                  : std::span<const gpu::InstanceMove>()});
        const Image expected = draw(*still, camera);
        EXPECT_EQ(moved.seen(), expected.seen());
        EXPECT_EQ(moved.color, expected.color);
    }
}

TEST_F(MotionTest, whatTurnsIntoItsMirrorImageShowsItsFront)
{
    std::mt19937 random(34);
    TestScene before_test, after_test;
    const auto before = randomPlaces(random);
    auto after = before;
    for (uint32_t rock = 0; rock < kRocks; ++rock)
        if (rock % 2 == 0)
            for (auto& row : after[rock].m)
                row[0] = -row[0];
    const formats::PackView before_pack = buildRocks(before_test, before);
    const formats::PackView after_pack = buildRocks(after_test, after);
    const auto turning = upload(before_pack), still = upload(after_pack), back = upload(before_pack);
    const auto movesTo = [&](const std::vector<Affine3>& places)
    {
        std::vector<gpu::InstanceMove> moves;
        for (uint32_t rock = 0; rock < kRocks; ++rock)
            moves.push_back(*gpu::moveInstance(*turning, rock, places[rock]));
        return moves;
    };
    for (int i = 0; i < 4; ++i)
    {
        const Camera camera = randomCamera(random, 6);
        const auto there = movesTo(after), home = movesTo(before);
        const Image turned = draw(*turning, camera, {.moves = there});
        const Image expected = draw(*still, camera);
        EXPECT_EQ(turned.seen(), expected.seen());
        EXPECT_EQ(turned.color, expected.color);
        const Image returned = draw(*turning, camera, {.moves = home});
        EXPECT_EQ(returned.seen(), draw(*back, camera).seen());
        EXPECT_NE(returned.seen(), turned.seen());
    }
}

TEST_F(MotionTest, whatTurnsIntoItsMirrorImageCastsItsShadow)
{
    std::mt19937 random(35);
    TestScene before_test, after_test;
    const auto before = randomPlaces(random);
    auto after = before;
    for (Affine3& place : after)
        for (auto& row : place.m)
            row[0] = -row[0];
    const formats::PackView before_pack = buildRocks(before_test, before);
    const formats::PackView after_pack = buildRocks(after_test, after);
    gpu::SceneOptions options;
    options.shadows.max_maps = 4;
    const auto turning = upload(before_pack, options), still = upload(after_pack, options);
    std::vector<gpu::InstanceMove> moves;
    for (uint32_t rock = 0; rock < kRocks; ++rock)
        moves.push_back(*gpu::moveInstance(*turning, rock, after[rock]));
    const Camera camera{.position = {0, 3, 12}, .target = {0, 0, 0}};
    const Image turned = draw(*turning, camera, {.moves = moves});
    const Image expected = draw(*still, camera);
    ASSERT_EQ(turned.color.size(), expected.color.size());
    // Depths of the maps are interpolated from corners in another order: points at the rims of shadows, where
    // rocks touch and where light grazes them, differ by a part of a shadow.
    size_t different = 0;
    for (size_t i = 0; i < turned.color.size(); ++i)
        different += std::abs(channel(turned.color[i], 1) - channel(expected.color[i], 1)) > 16 ? 1u : 0u;
    EXPECT_LT(different * 375, turned.color.size());
}

TEST_F(MotionTest, cullingIsLosslessWhileThingsMove)
{
    std::mt19937 random(32);
    TestScene test;
    const auto places = randomPlaces(random);
    const formats::PackView pack = buildRocks(test, places);
    const auto scene = upload(pack);
    gpu::FrameTargets targets = makeTargets(160, 120);
    Camera camera = randomCamera(random, 5);
    size_t drawn = 0, late = 0, all = 0;
    for (int frame = 0; frame < 80; ++frame)
    {
        if (frame % 10 == 0)
            camera = randomCamera(random, 5);
        std::vector<gpu::InstanceMove> moves;
        for (uint32_t rock = 0; rock < kRocks; ++rock)
            if (random() % 3 == 0)
            {
                const auto move = gpu::moveInstance(*scene, rock, choosePlace(rock, random));
                ASSERT_TRUE(move.ok());
                moves.push_back(*move);
            }
        const Image some = draw(*scene, targets, camera, {.error_pixels = 2, .moves = moves});
        const Image whole = draw(*scene, camera, {.error_pixels = 2, .flags = 0});
        ASSERT_EQ(some.seen(), whole.seen()) << "frame " << frame;
        drawn += some.list.slots.size();
        late += some.list.slots.size() - some.list.counters.early_clusters;
        all += whole.list.slots.size();
    }
    EXPECT_LT(drawn, all);
    EXPECT_GT(late, 80u) << "a late phase that finds nothing is not tested";
}

TEST_F(MotionTest, clipsDrawRocksWhereTheCpuPutsThem)
{
    TestScene animated_test, still_test;
    const auto rock = [](TestScene& test)
    { return test.addMesh(withMaterial(shapes::rock(20, 0.3f), test.addMaterial(plainMaterial()))); };
    fillAnimatedRocks(animated_test, rock(animated_test));
    const formats::PackView animated_pack = animated_test.build();
    pack::PosePlayer player(animated_pack);
    player.blend({0, 3}, {1, 2}, 0.5);
    // slide: 5 along x, rise: 2 along y
    const uint32_t still_rock = rock(still_test);
    for (const Float3 place : {Float3{0, 0, 0}, Float3{3.5f, 1, 0}, Float3{3.5f, 2, 0}, Float3{3.5f, 1, 3}})
        still_test.addInstance(still_rock, translated(place));
    const formats::PackView still_pack = still_test.build();

    const auto animated = upload(animated_pack);
    const auto still = upload(still_pack);
    std::vector<gpu::InstanceMove> moves;
    for (const pack::MovedInstance& moved : player.moved())
    {
        const auto move = gpu::moveInstance(*animated, moved.instance, moved.world_from_object);
        ASSERT_TRUE(move.ok());
        moves.push_back(*move);
    }
    ASSERT_EQ(moves.size(), 3u);
    const Camera camera{.position = {4, 3, 9}, .target = {2, 1, 0}};
    EXPECT_EQ(draw(*animated, camera, {.moves = moves}).color, draw(*still, camera).color);
}

TEST_F(MotionTest, whatAnInstanceCannotDoIsNamed)
{
    std::mt19937 random(33);
    TestScene test;
    const auto places = randomPlaces(random);
    const auto scene = upload(buildRocks(test, places));
    Affine3 broken = places[1];
    broken.m[2][3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(gpu::moveInstance(*scene, kRocks, places[1]).error().issue, Issue::usage);
    EXPECT_EQ(gpu::moveInstance(*scene, 1, broken).error().issue, Issue::usage);
    EXPECT_TRUE(gpu::moveInstance(*scene, 1, places[1]).ok());
}

} // namespace hearth::test
