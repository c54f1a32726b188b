// Tests the pose player: which instances a clip moves, their transforms, and the palettes of deformed ones.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/pose_player.h"

#include "runtime/pack/scene_boxes.h"
#include "runtime/viewer/camera_fit.h"
#include "tests/runtime/gpu/animated_rocks.h"
#include "tests/runtime/gpu/deformed_scene.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>
#include <map>

namespace hearth::test
{

namespace
{

using Places = std::map<uint32_t, Float3>;

Places movedBy(const pack::PosePlayer& player)
{
    Places places;
    for (const pack::MovedInstance& moved : player.moved())
        places[moved.instance] = transformPoint(moved.world_from_object, {});
    return places;
}

} // namespace

TEST(PosePlayer, clipsMoveWhatHangsFromTheirNodes)
{
    TestScene test;
    fillAnimatedRocks(test, test.addMesh(withMaterial(shapes::rock(8, 0.2f), kInvalidIndex)));
    const formats::PackView pack = test.build();
    pack::PosePlayer player(pack);
    EXPECT_EQ(movedBy(player), Places{});
    EXPECT_EQ(player.transforms().size(), 3u);

    player.play({0, 1});
    EXPECT_EQ(movedBy(player), (Places{{1, {3, 0, 0}}, {2, {3, 1, 0}}, {3, {3, 0, 3}}}));
    player.play({0, 1});
    EXPECT_EQ(movedBy(player), Places{}) << "they stand there already";
    player.play({0, 9});
    EXPECT_EQ(movedBy(player).at(1), (Float3{6, 0, 0})) << "beyond its keys a clip rests";
    player.play({1, 2});
    EXPECT_EQ(movedBy(player).at(2), (Float3{2, 3, 0})) << "what the other clip moved is at rest again";
    player.rest();
    EXPECT_EQ(movedBy(player).at(1), (Float3{2, 0, 0}));
}

TEST(PosePlayer, twoClipsAreBlended)
{
    TestScene test;
    fillAnimatedRocks(test, test.addMesh(withMaterial(shapes::rock(8, 0.2f), kInvalidIndex)));
    const formats::PackView pack = test.build();
    pack::PosePlayer player(pack);
    player.blend({0, 4}, {1, 4}, 0.25);
    EXPECT_EQ(movedBy(player).at(1), (Float3{5, 1, 0}));
    player.blend({0, 4}, {1, 4}, 1);
    EXPECT_EQ(movedBy(player).at(1), (Float3{2, 4, 0}));
}

TEST(PosePlayer, findsClipsByNameOrNumber)
{
    TestScene test;
    fillAnimatedRocks(test, test.addMesh(withMaterial(shapes::rock(8, 0.2f), kInvalidIndex)));
    const formats::PackView pack = test.build();
    EXPECT_EQ(pack::findAnimation(pack, "rise"), 1u);
    EXPECT_EQ(pack::findAnimation(pack, "0"), 0u);
    for (const char* none : {"2", "", "ris", "rise ", "1x", "-1"})
        EXPECT_EQ(pack::findAnimation(pack, none), std::nullopt) << none;
}

TEST(PosePlayer, palettesAreThoseOfTheSkin)
{
    const DeformedScene test(
        {.limbs = 1, .tentacles = 1, .blobs = 1, .rocks = 0, .pose_count = 2, .rings = 12}, 21);
    const pack::PosePlayer player(test.pack());
    ASSERT_EQ(player.posed().size(), 3u);
    const size_t joints[] = {6, 12, 1}, targets[] = {0, 3, 2};
    for (size_t i = 0; i < 3; ++i)
    {
        const pack::PosedInstance& posed = player.posed()[i];
        EXPECT_EQ(posed.instance, test.deformedInstances()[i]);
        ASSERT_EQ(posed.world_from_bind.size(), joints[i]);
        ASSERT_EQ(posed.morph_weights.size(), targets[i]);
    }
    // the rest pose of the test's skins is the bind pose
    for (size_t i = 0; i < 2; ++i)
        for (const Affine3d& joint : player.posed()[i].world_from_bind)
            EXPECT_LT(length(transformPoint(joint, {1, 2, 3}) - Double3{1, 2, 3}), 1e-6);
    EXPECT_EQ(narrowed(player.posed()[2].world_from_bind[0]),
              test.pack().instances()[test.deformedInstances()[2]].world_from_object);
}

TEST(SceneBoxes, followWhatMoves)
{
    TestScene test;
    fillAnimatedRocks(test, test.addMesh(withMaterial(shapes::rock(8, 0.2f), kInvalidIndex)));
    const formats::PackView pack = test.build();
    pack::PosePlayer player(pack);
    const Box3 rest = pack::sceneBounds(pack);
    player.play({1, 4});
    const Box3 risen = pack::sceneBounds(pack, player);
    EXPECT_NEAR(risen.max.y, rest.max.y + 4, 1e-5f);
    EXPECT_EQ(risen.min, rest.min);
}

} // namespace hearth::test
