// Tests poses with known answers: interpolation, blending, hierarchies and palettes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hearth::test
{

using namespace formats;

namespace
{

constexpr double kPi = std::numbers::pi;
constexpr double kTolerance = 1e-6; ///< keys are floats

/// A scene that owns its tables.
struct Scene
{
    std::vector<NodeRecord> nodes;
    std::vector<SkinRecord> skins;
    std::vector<JointRecord> joints;
    std::vector<AnimationRecord> animations{AnimationRecord{}};
    std::vector<AnimationChannelRecord> channels;
    std::vector<float> keys;
    std::vector<uint32_t> key_bits;
    std::vector<float> morph_weights;

    uint32_t addNode(uint32_t parent, Float3 translation = {})
    {
        NodeRecord node{};
        node.parent = parent;
        node.has_trs = 1;
        node.translation = translation;
        node.rotation = {0, 0, 0, 1};
        node.scale = {1, 1, 1};
        nodes.push_back(node);
        return static_cast<uint32_t>(nodes.size() - 1);
    }

    /// Add a channel to the single animation.
    void addChannel(uint32_t node, AnimationPath path, Interpolation interpolation, uint32_t components,
                    const std::vector<float>& times, const std::vector<float>& values)
    {
        AnimationChannelRecord channel{};
        channel.target = node;
        channel.path = static_cast<uint32_t>(path);
        channel.interpolation = static_cast<uint32_t>(interpolation);
        channel.components = components;
        channel.key_count = static_cast<uint32_t>(times.size());
        channel.first_time = static_cast<uint32_t>(keys.size());
        keys.insert(keys.end(), times.begin(), times.end());
        channel.first_value = static_cast<uint32_t>(keys.size());
        keys.insert(keys.end(), values.begin(), values.end());
        channels.push_back(channel);
        ++animations[0].channels.count;
    }

    AnimationTables tables() const
    {
        return {nodes, skins, joints, animations, channels, keys, morph_weights, key_bits};
    }

    ScenePose at(double time) const
    {
        ScenePose pose = restPose(tables());
        sampleAnimation(tables(), animations[0], time, pose);
        return pose;
    }

    std::vector<Affine3d> computeWorld(const ScenePose& pose) const
    {
        std::vector<Affine3d> world(nodes.size());
        poseNodes(tables(), pose, nodesParentsFirst(nodes), world);
        return world;
    }
};

std::vector<float> rotationAboutZ(double radians)
{
    return {0, 0, static_cast<float>(std::sin(radians / 2)), static_cast<float>(std::cos(radians / 2))};
}

double angleAboutZ(const Quaternion& q)
{
    return 2 * std::atan2(q[2], q[3]);
}

std::vector<float> joined(std::initializer_list<std::vector<float>> lists)
{
    std::vector<float> all;
    for (const std::vector<float>& list : lists)
        all.insert(all.end(), list.begin(), list.end());
    return all;
}

} // namespace

TEST(Animation, holdsTheFirstAndTheLastKey)
{
    Scene scene;
    const uint32_t node = scene.addNode(kInvalidIndex);
    scene.addChannel(node, AnimationPath::translation, Interpolation::linear, 3, {1, 2}, {1, 2, 3, 4, 5, 6});
    EXPECT_EQ(scene.at(0).nodes[node].translation.x, 1);
    EXPECT_EQ(scene.at(1).nodes[node].translation.y, 2);
    EXPECT_EQ(scene.at(2).nodes[node].translation.z, 6);
    EXPECT_EQ(scene.at(9).nodes[node].translation.x, 4);
}

TEST(Animation, interpolatesAsTheChannelSays)
{
    for (const auto& [interpolation, expected] :
         {std::pair(Interpolation::step, 0.0), std::pair(Interpolation::linear, 2.5)})
    {
        Scene scene;
        const uint32_t node = scene.addNode(kInvalidIndex);
        scene.addChannel(node, AnimationPath::scale, interpolation, 3, {0, 4}, {0, 0, 0, 10, 10, 10});
        EXPECT_DOUBLE_EQ(scene.at(1).nodes[node].scale.x, expected);
    }
}

TEST(Animation, cubicSplineIsHermites)
{
    // through p(t) = t^3 - 2 t: value and slope at 0 and 2
    Scene scene;
    const uint32_t node = scene.addNode(kInvalidIndex);
    const auto value = [](float t) { return t * t * t - 2 * t; };
    const auto slope = [](float t) { return 3 * t * t - 2; };
    std::vector<float> values;
    for (const float t : {0.0f, 2.0f})
        for (const float v : {slope(t), value(t), slope(t)})
            values.insert(values.end(), 3, v);
    scene.addChannel(node, AnimationPath::translation, Interpolation::cubic_spline, 3, {0, 2}, values);
    for (const float t : {0.0f, 0.3f, 1.0f, 1.9f, 2.0f})
        EXPECT_NEAR(scene.at(t).nodes[node].translation.y, double{value(t)}, kTolerance);
}

TEST(Animation, rotationsGoAlongTheShorterArc)
{
    Scene scene;
    const uint32_t node = scene.addNode(kInvalidIndex);
    std::vector<float> far = rotationAboutZ(1.0);
    for (float& component : far)
        component = -component; // the same rotation, antipodal quaternion
    scene.addChannel(node, AnimationPath::rotation, Interpolation::linear, 4, {0, 1},
                     joined({rotationAboutZ(0.2), far}));
    EXPECT_NEAR(angleAboutZ(scene.at(0.25).nodes[node].rotation), 0.4, kTolerance);
    EXPECT_NEAR(angleAboutZ(scene.at(0.5).nodes[node].rotation), 0.6, kTolerance);
}

TEST(Animation, ofKeysAtOneTimeTheLastHolds)
{
    Scene scene;
    const uint32_t node = scene.addNode(kInvalidIndex);
    scene.addChannel(node, AnimationPath::translation, Interpolation::linear, 3, {0, 1, 1, 2},
                     {0, 0, 0, 2, 0, 0, 8, 0, 0, 6, 0, 0});
    EXPECT_DOUBLE_EQ(scene.at(0.5).nodes[node].translation.x, 1);
    EXPECT_DOUBLE_EQ(scene.at(1).nodes[node].translation.x, 8);
    EXPECT_DOUBLE_EQ(scene.at(1.5).nodes[node].translation.x, 7);
}

TEST(Animation, morphWeightsStandWhereTheNodesDo)
{
    Scene scene;
    scene.addNode(kInvalidIndex);
    const uint32_t node = scene.addNode(kInvalidIndex);
    scene.morph_weights = {0.5f, 0.1f, 0.2f};
    scene.nodes[node].morph_weights = {1, 2};
    scene.addChannel(node, AnimationPath::weights, Interpolation::linear, 2, {0, 1}, {0, 1, 1, 0});
    const ScenePose pose = scene.at(0.25);
    EXPECT_DOUBLE_EQ(pose.morph_weights[0], 0.5);
    EXPECT_DOUBLE_EQ(pose.morph_weights[1], 0.25);
    EXPECT_DOUBLE_EQ(pose.morph_weights[2], 0.75);
}

TEST(Animation, blendsNodeByNode)
{
    ScenePose from{{NodePose{}}, {0}}, to{{NodePose{{2, 0, 0}, {0, 0, 1, 0}, {3, 3, 3}}}, {1}};
    to.nodes[0].rotation = {0, 0, std::sin(0.5), std::cos(0.5)};
    ScenePose between;
    blendPoses(from, to, 0.25, between);
    EXPECT_DOUBLE_EQ(between.nodes[0].translation.x, 0.5);
    EXPECT_DOUBLE_EQ(between.nodes[0].scale.y, 1.5);
    EXPECT_NEAR(angleAboutZ(between.nodes[0].rotation), 0.25, 1e-12);
    EXPECT_DOUBLE_EQ(between.morph_weights[0], 0.25);
}

TEST(Animation, slerpKeepsItsSpeedAndItsLength)
{
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 1000; ++i)
    {
        const double arc = i % 3 == 0 ? 1e-7 * i : 1.5 * i / 1000.0; // angle between the quaternions
        Quaternion from{normal(random), normal(random), normal(random), normal(random)};
        from = slerp(from, from, 0); // normalised
        const Quaternion side{-from[1], from[0], -from[3], from[2]};
        Quaternion to;
        for (size_t c = 0; c < 4; ++c)
            to[c] = std::cos(arc) * from[c] + std::sin(arc) * side[c];
        const Quaternion q = slerp(from, to, 0.3);
        double along = 0, length2 = 0;
        for (size_t c = 0; c < 4; ++c)
        {
            along += q[c] * side[c];
            length2 += q[c] * q[c];
        }
        EXPECT_NEAR(along, std::sin(0.3 * arc), 1e-12);
        EXPECT_NEAR(length2, 1, 1e-12);
    }
}

TEST(Animation, parentsMayStandBehindTheirChildren)
{
    Scene scene;
    scene.addNode(2, {1, 0, 0});
    scene.addNode(kInvalidIndex, {0, 0, 5});
    scene.addNode(1, {0, 1, 0});
    scene.nodes[1].rotation = {0, 0, static_cast<float>(std::sin(kPi / 4)),
                               static_cast<float>(std::cos(kPi / 4))};
    const std::vector<Affine3d> world = scene.computeWorld(restPose(scene.tables()));
    // a quarter turn about z: x becomes y, y becomes -x
    EXPECT_NEAR(world[0].m[0][3], -1, kTolerance);
    EXPECT_NEAR(world[0].m[1][3], 1, kTolerance);
    EXPECT_NEAR(world[0].m[2][3], 5, kTolerance);
}

TEST(Animation, aMatrixStaysWhateverThePoseSays)
{
    Scene scene;
    const uint32_t node = scene.addNode(kInvalidIndex);
    scene.nodes[node].has_trs = 0;
    scene.nodes[node].parent_from_node.m[0][3] = 7;
    ScenePose pose = restPose(scene.tables());
    pose.nodes[node].translation = {1, 1, 1};
    EXPECT_EQ(scene.computeWorld(pose)[node].m[0][3], 7);
}

TEST(Animation, paletteCarriesTheBindPose)
{
    Scene scene;
    const uint32_t root = scene.addNode(kInvalidIndex, {0, 2, 0});
    const uint32_t tip = scene.addNode(root, {0, 1, 0});
    for (const uint32_t node : {root, tip})
    {
        JointRecord joint{};
        joint.node = node;
        joint.joint_from_bind = {};
        joint.joint_from_bind.m[1][3] = node == tip ? -1.0f : 0.0f; // bound with the root at the origin
        scene.joints.push_back(joint);
    }
    SkinRecord skin{};
    skin.joints = {0, 2};
    scene.skins.push_back(skin);
    std::vector<Affine3d> palette(2);
    skinPalette(scene.tables(), skin, scene.computeWorld(restPose(scene.tables())), palette);
    for (const Affine3d& world_from_bind : palette)
        EXPECT_DOUBLE_EQ(transformPoint(world_from_bind, {0.5, 0.5, 0}).y, 2.5);
}

TEST(Animation, packedKeysAreTheFloatsOfTheirCodes)
{
    // times 0, 3 and 5 of a table; x and z move in steps of a quarter
    Scene packed;
    packed.addNode(kInvalidIndex);
    packed.animations.push_back({});
    packed.addChannel(0, AnimationPath::translation, Interpolation::linear, 3, {0, 1, 2, 3, 4, 5},
                      {-1, 2, 0, 0.25f});
    AnimationChannelRecord& channel = packed.channels[0];
    channel.encoding = static_cast<uint32_t>(KeyEncoding::packed);
    channel.key_count = 3;
    channel.time_bits = 3;
    channel.value_bits[0] = 3;
    channel.value_bits[2] = 24;
    // 30 bits a key: the second and the third lie in two words each
    uint64_t bits[2]{};
    const std::array<std::array<uint64_t, 3>, 3> keys{{{0, 7, 0xFFFFFF}, {3, 2, 0}, {5, 4, 0x800001}}};
    for (size_t key = 0; key < keys.size(); ++key)
    {
        const uint64_t code = keys[key][0] | keys[key][1] << 3 | keys[key][2] << 6;
        bits[key * 30 / 64] |= code << (key * 30 % 64);
        if (key * 30 % 64 > 34)
            bits[key * 30 / 64 + 1] |= code >> (64 - key * 30 % 64);
    }
    packed.key_bits = {static_cast<uint32_t>(bits[0]), static_cast<uint32_t>(bits[0] >> 32),
                       static_cast<uint32_t>(bits[1])};
    Scene floats;
    floats.addNode(kInvalidIndex);
    floats.animations.push_back({});
    floats.addChannel(
        0, AnimationPath::translation, Interpolation::linear, 3, {0, 3, 5},
        {-1 + 7 * 0.25f, 2, 0xFFFFFF * 0.25f, -1 + 2 * 0.25f, 2, 0, -1 + 4 * 0.25f, 2, 0x800001 * 0.25f});
    for (double time = -1; time < 6; time += 0.125)
    {
        const Double3 is = packed.at(time).nodes[0].translation,
                      wanted = floats.at(time).nodes[0].translation;
        EXPECT_EQ(is.x, wanted.x) << time;
        EXPECT_EQ(is.y, wanted.y) << time;
        EXPECT_EQ(is.z, wanted.z) << time;
    }
}

TEST(Animation, packedRotationsHaveTheLengthOne)
{
    // one key for each component that can be omitted; the three others are .5
    Scene scene;
    scene.addNode(kInvalidIndex);
    scene.animations.push_back({});
    scene.addChannel(0, AnimationPath::rotation, Interpolation::step, 4, {0, 1, 2, 3},
                     {-0.5f, 0.5f, 0.5f, 0.25f});
    scene.channels[0].encoding = static_cast<uint32_t>(KeyEncoding::packed);
    scene.channels[0].value_bits[0] = 3;
    // 5 bits a key: the omitted component and the code of the first of the others: -.5, -.25, 0 and .5
    scene.key_bits = {0u | 0u << 2 | (1u | 1u << 2) << 5 | (2u | 2u << 2) << 10 | (3u | 4u << 2) << 15};
    const std::array<Quaternion, 4> wanted{{{0.5, -0.5, 0.5, 0.5},
                                            {-0.25, std::sqrt(0.4375), 0.5, 0.5},
                                            {0, 0.5, std::sqrt(0.5), 0.5},
                                            {0.5, 0.5, 0.5, 0.5}}};
    for (size_t key = 0; key < wanted.size(); ++key)
        for (size_t i = 0; i < 4; ++i)
            EXPECT_NEAR(scene.at(static_cast<double>(key)).nodes[0].rotation[i], wanted[key][i], 1e-15)
                << key << " " << i;
}

} // namespace hearth::test
