// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/animation/limb_character.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hearth::test
{

using namespace formats;
using skinning::DeformedCluster;

namespace
{

constexpr uint32_t kJoints = 60;
constexpr uint32_t kKeys = 60;
constexpr uint32_t kLimbs = 6;
constexpr uint32_t kClusterVertices = 88; ///< of a typical cluster of 128 triangles

void addSkeleton(Character& character)
{
    constexpr uint32_t kLength = kJoints / kLimbs;
    for (uint32_t i = 0; i < kJoints; ++i)
    {
        NodeRecord node{};
        node.mesh = node.skin = kInvalidIndex;
        node.has_trs = 1;
        node.parent = i == 0 ? kInvalidIndex : i % kLength == 0 ? 0 : i - 1;
        node.translation =
            i % kLength == 0 ? Float3{static_cast<float>(i) * 0.01f, 0, 0} : Float3{0, 0.1f, 0};
        node.rotation = {0, 0, 0, 1};
        node.scale = {1, 1, 1};
        character.nodes.push_back(node);
        JointRecord joint{i, {}, {}};
        joint.joint_from_bind.m[0][3] = -static_cast<float>(i - i % kLength) * 0.01f;
        joint.joint_from_bind.m[1][3] = -static_cast<float>(i % kLength) * 0.1f;
        character.joints.push_back(joint);
    }
}

void addClip(Character& character, uint32_t clip)
{
    AnimationRecord animation{};
    animation.channels = {static_cast<uint32_t>(character.channels.size()), kJoints};
    animation.duration = 2;
    character.animations.push_back(animation);
    for (uint32_t joint = 0; joint < kJoints; ++joint)
    {
        AnimationChannelRecord channel{};
        channel.target = joint;
        channel.path = static_cast<uint32_t>(AnimationPath::rotation);
        channel.interpolation = static_cast<uint32_t>(Interpolation::linear);
        channel.components = 4;
        channel.key_count = kKeys;
        channel.first_time = static_cast<uint32_t>(character.keys.size());
        for (uint32_t key = 0; key < kKeys; ++key)
            character.keys.push_back(static_cast<float>(key) * 2.0f / (kKeys - 1));
        channel.first_value = static_cast<uint32_t>(character.keys.size());
        for (uint32_t key = 0; key < kKeys; ++key)
        {
            const float phase = static_cast<float>(key * (clip + 1)) * 0.1f + static_cast<float>(joint);
            const Float3 half_turn{0.15f * std::sin(phase), 0.03f * std::cos(1.7f * phase),
                                   0.05f * std::sin(0.6f * phase)};
            const float w = std::sqrt(1 - dot(half_turn, half_turn));
            character.keys.insert(character.keys.end(), {half_turn.x, half_turn.y, half_turn.z, w});
        }
        character.channels.push_back(channel);
    }
}

/// Add the influences of a vertex: of the joint, its neighbours in the limb, joint 0 and, if there are 8,
/// farther joints of the limb.
/// along  position between the joint, 0, and the next one, 1
void addInfluences(DeformedCluster& cluster, uint32_t joint, float along)
{
    constexpr uint32_t kLength = kJoints / kLimbs;
    const uint32_t first = joint - joint % kLength, last = first + kLength - 1;
    const auto neighbour = [&](int steps)
    {
        const int moved = static_cast<int>(joint) + steps;
        return static_cast<uint16_t>(std::clamp(moved, static_cast<int>(first), static_cast<int>(last)));
    };
    double to_behind = 0.5 * double{along} * double{along};
    double to_before = 0.5 * (1 - double{along}) * (1 - double{along});
    double own = 0.98 - to_before - to_behind;
    for (const uint16_t j : {neighbour(0), neighbour(-1), neighbour(1), uint16_t{0}})
        cluster.joints.push_back(j);
    if (cluster.influences == 4)
    {
        cluster.weights.insert(cluster.weights.end(), {own, to_before, to_behind, 0.02});
        return;
    }
    for (const int steps : {-2, 2, -3, 3})
        cluster.joints.push_back(neighbour(steps));
    cluster.weights.insert(cluster.weights.end(), {0.7 * own, 0.7 * to_before, 0.7 * to_behind, 0.02});
    cluster.weights.insert(cluster.weights.end(), {0.098, 0.098, 0.049, 0.049});
}

/// Patch of skin around a joint, with weights that blend into other joints of the limb.
DeformedCluster patch(uint32_t number, uint32_t influences)
{
    const uint32_t joint = number % kJoints, limb = joint / (kJoints / kLimbs);
    const float turn = static_cast<float>(number / kJoints) * 0.33f;
    DeformedCluster cluster;
    cluster.influences = influences;
    for (uint32_t v = 0; v < kClusterVertices; ++v)
    {
        const float along = static_cast<float>(v / 11) / 7, across = static_cast<float>(v % 11) * 0.03f;
        cluster.positions.push_back({static_cast<float>(limb) * 0.1f + 0.04f * std::cos(turn + across),
                                     (static_cast<float>(joint % (kJoints / kLimbs)) + along) * 0.1f,
                                     0.04f * std::sin(turn + across)});
        addInfluences(cluster, joint, along);
    }
    for (uint32_t v = 0; v + 12 < kClusterVertices; ++v)
        if (v % 11 != 10)
            cluster.indices.insert(cluster.indices.end(), {v, v + 1, v + 11, v + 1, v + 12, v + 11});
    return cluster;
}

} // namespace

Character limbCharacter(const LimbCharacterSize& size)
{
    Character character;
    character.skins.push_back({{}, kInvalidIndex, {0, kJoints}, 0});
    character.mesh.skin = 0;
    addSkeleton(character);
    for (uint32_t clip = 0; clip < size.clips; ++clip)
        addClip(character, clip);
    // patches of a small character are spread over its joints
    const uint32_t patches = size.vertices / kClusterVertices;
    const uint32_t step = std::max(kJoints / patches, 1u);
    for (uint32_t i = 0; i < patches; ++i)
        character.mesh.clusters.push_back(patch(i * step, size.influences));
    return character;
}

} // namespace hearth::test
