// Tests bounds of instances over a clip against poses at many times.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/queries/clip_bounds.h"

#include "runtime/pack/scene_boxes.h"
#include "tests/runtime/gpu/animated_rocks.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using formats::AnimationPath;
using formats::Interpolation;

constexpr float kSeconds = 3;

/// A grid on the third node of a chain, four metres along x from the first, and clip 0 without channels.
class ChainScene
{
public:
    ChainScene()
    {
        const uint32_t mesh = scene_.addMesh(withMaterial(shapes::grid(2), kInvalidIndex));
        PackModel& model = scene_.model();
        root_ = addTrsNode(model, kInvalidIndex, {0, 0, 0});
        arm_ = addTrsNode(model, root_, {3, 0, 0});
        const uint32_t hand = addTrsNode(model, arm_, {1, 0, 0});
        scene_.addInstance(mesh, translated({4, 0, 0}));
        model.instances.back().node = hand;
        model.nodes[hand].mesh = mesh;
        model.nodes.pop_back(); // the node that addInstance made
        const auto name = static_cast<uint32_t>(model.strings.size());
        model.strings += "swing";
        model.animations.push_back({{name, 5}, {0, 0}, {0, 0}, kSeconds, 0});
    }

    uint32_t root() const { return root_; }
    uint32_t arm() const { return arm_; }

    /// Add a channel to the clip.
    /// rows  numbers of its keys, of splines with their tangents
    void addChannel(uint32_t node, AnimationPath path, Interpolation interpolation,
                    const std::vector<float>& times, const std::vector<std::vector<float>>& rows)
    {
        PackModel& model = scene_.model();
        formats::AnimationChannelRecord channel{};
        channel.target = node;
        channel.path = static_cast<uint32_t>(path);
        channel.interpolation = static_cast<uint32_t>(interpolation);
        channel.components = static_cast<uint32_t>(rows[0].size());
        channel.key_count = static_cast<uint32_t>(times.size());
        channel.first_time = static_cast<uint32_t>(model.keys.size());
        model.keys.insert(model.keys.end(), times.begin(), times.end());
        channel.first_value = static_cast<uint32_t>(model.keys.size());
        for (const std::vector<float>& row : rows)
            model.keys.insert(model.keys.end(), row.begin(), row.end());
        model.channels.push_back(channel);
        model.animations[0].channels.count = static_cast<uint32_t>(model.channels.size());
        model.animations[0].light_channels.first = model.animations[0].channels.count;
    }

    /// Expect that the bounds contain the grid at all times, and exceed them by a share of their size at
    /// most.
    void expectBounds(float share)
    {
        const formats::PackView view = scene_.build();
        const Box3 bounds = pack::clipBounds(view, 0, {0, 1});
        pack::PosePlayer player(view);
        Box3 swept;
        constexpr int kTimes = 4001; // none of them is a whole share of the clip
        for (int i = -10; i < kTimes + 10; ++i)
        {
            player.play({0, double{kSeconds} * i / kTimes});
            swept.add(pack::sceneBounds(view, player));
        }
        for (int axis = 0; axis < 3; ++axis)
        {
            EXPECT_LE(bounds.min[axis], swept.min[axis]) << axis;
            EXPECT_GE(bounds.max[axis], swept.max[axis]) << axis;
            const float room = share * length(swept.max - swept.min);
            EXPECT_GE(bounds.min[axis], swept.min[axis] - room) << axis;
            EXPECT_LE(bounds.max[axis], swept.max[axis] + room) << axis;
        }
    }

private:
    TestScene scene_;
    uint32_t root_ = 0, arm_ = 0;
};

/// Rotation about z.
std::vector<float> turn(float degrees)
{
    const float half = degrees * 3.14159265f / 360;
    return {0, 0, std::sin(half), std::cos(half)};
}

} // namespace

TEST(ClipBounds, holdWhileAnArmSwings)
{
    ChainScene scene;
    scene.addChannel(scene.root(), AnimationPath::rotation, Interpolation::linear, {0, 1, 3},
                     {turn(0), turn(170), turn(330)});
    scene.expectBounds(0.05f);
    scene.addChannel(scene.arm(), AnimationPath::rotation, Interpolation::linear, {0.5f, 0.6f, 2.9f},
                     {turn(0), turn(120), turn(-50)});
    scene.expectBounds(0.1f);
}

TEST(ClipBounds, holdForSplinesStepsAndScales)
{
    ChainScene scene;
    scene.addChannel(
        scene.root(), AnimationPath::translation, Interpolation::cubic_spline, {0, 2, 3},
        {{0, 0, 0}, {0, 0, 0}, {9, 0, 0}, {0, -9, 4}, {0, 2, 0}, {5, 0, 0}, {0, 0, 0}, {2, 1, 0}, {0, 0, 0}});
    scene.expectBounds(0.05f);
    scene.addChannel(scene.arm(), AnimationPath::scale, Interpolation::linear, {0, 3},
                     {{1, 1, 1}, {0.5f, -2, 3}});
    scene.expectBounds(0.05f);
    scene.addChannel(scene.arm(), AnimationPath::translation, Interpolation::step, {0, 1.5f, 2},
                     {{3, 0, 0}, {0, 7, 0}, {0, 0, -5}});
    scene.expectBounds(0.05f);
}

TEST(ClipBounds, holdForRotationsBySplines)
{
    ChainScene scene;
    scene.addChannel(scene.arm(), AnimationPath::rotation, Interpolation::cubic_spline, {0, 3},
                     {turn(0), turn(0), {0, 0, 1, 1}, {0, 0, 2, -1}, turn(90), turn(0)});
    scene.expectBounds(2);
}

TEST(ClipBounds, areThoseOfRestWhereNothingMoves)
{
    TestScene test;
    fillAnimatedRocks(test, test.addMesh(withMaterial(shapes::grid(2), kInvalidIndex)));
    const formats::PackView view = test.build();
    const Box3 standing = pack::clipBounds(view, 0, {0, 1}),
               rest = pack::instanceBounds(view, pack::PosePlayer(view), {0, 1});
    EXPECT_LT(length(standing.min - rest.min) + length(standing.max - rest.max), 1e-5f);
    const Box3 moved = pack::clipBounds(view, 0, {1, 1});
    EXPECT_NEAR(moved.min.x, 2, 1e-4f) << "a grid of one metre goes from x = 2 to 6";
    EXPECT_NEAR(moved.max.x, 7, 1e-4f);
    EXPECT_TRUE(pack::clipBounds(view, 0, {0, 0}).empty());
}

} // namespace hearth::test
