// Benchmarks the bounds of a character of 100,000 vertices, 60 joints and 20 clips.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/cluster_bounds.h"
#include "cook/skinning/group_spheres.h"

#include <array>
#include <benchmark/benchmark.h>
#include <cmath>
#include <optional>

#include <tbb/global_control.h>

namespace
{

using namespace hearth;
using namespace hearth::formats;
using skinning::DeformedCluster;

constexpr uint32_t kJoints = 60;
constexpr uint32_t kClips = 20;
constexpr uint32_t kKeys = 60;
constexpr uint32_t kLimbs = 6;
constexpr uint32_t kVertices = 100'000;
constexpr uint32_t kClusterVertices = 88; ///< of a typical cluster of 128 triangles

/// Six limbs of ten joints that bend back and forth, at another speed in each clip.
struct Character
{
    std::vector<NodeRecord> nodes;
    std::vector<JointRecord> joints;
    std::vector<SkinRecord> skins{{{}, kInvalidIndex, {0, kJoints}, 0}};
    std::vector<AnimationRecord> animations;
    std::vector<AnimationChannelRecord> channels;
    std::vector<float> keys;
    std::vector<DeformedCluster> clusters;

    AnimationTables tables() const { return {nodes, skins, joints, animations, channels, keys, {}, {}}; }
};

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
        channel.node = joint;
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

/// Patch of skin around a joint, with weights that blend into the joints before and behind.
DeformedCluster patch(uint32_t number)
{
    const uint32_t joint = number % kJoints, limb = joint / (kJoints / kLimbs);
    const uint32_t before = joint % (kJoints / kLimbs) == 0 ? joint : joint - 1;
    const uint32_t behind = (joint + 1) % (kJoints / kLimbs) == 0 ? joint : joint + 1;
    const float turn = static_cast<float>(number / kJoints) * 0.33f;
    DeformedCluster cluster;
    cluster.influences = 4;
    for (uint32_t v = 0; v < kClusterVertices; ++v)
    {
        const float along = static_cast<float>(v / 11) / 7, across = static_cast<float>(v % 11) * 0.03f;
        cluster.positions.push_back({static_cast<float>(limb) * 0.1f + 0.04f * std::cos(turn + across),
                                     (static_cast<float>(joint % (kJoints / kLimbs)) + along) * 0.1f,
                                     0.04f * std::sin(turn + across)});
        const double to_behind = 0.5 * double{along} * double{along};
        const double to_before = 0.5 * (1 - double{along}) * (1 - double{along});
        for (const uint32_t j : {joint, before, behind, 0u})
            cluster.joints.push_back(static_cast<uint16_t>(j));
        for (const double weight : {0.98 - to_before - to_behind, to_before, to_behind, 0.02})
            cluster.weights.push_back(weight);
    }
    for (uint32_t v = 0; v + 12 < kClusterVertices; ++v)
        if (v % 11 != 10)
            cluster.indices.insert(cluster.indices.end(), {v, v + 1, v + 11, v + 1, v + 12, v + 11});
    return cluster;
}

Character makeCharacter()
{
    Character character;
    addSkeleton(character);
    for (uint32_t clip = 0; clip < kClips; ++clip)
        addClip(character, clip);
    for (uint32_t i = 0; i < kVertices / kClusterVertices; ++i)
        character.clusters.push_back(patch(i));
    return character;
}

std::vector<animation_bounds::Box3d> computeReach(const Character& character)
{
    std::vector<animation_bounds::Box3d> reach(kJoints);
    for (const DeformedCluster& cluster : character.clusters)
        for (size_t i = 0; i < cluster.joints.size(); ++i)
            animation_bounds::add(reach[cluster.joints[i]], widen(cluster.positions[i / cluster.influences]));
    return reach;
}

/// Bound one level of clusters in groups of 16, like the source level of a hierarchy.
void characterBounds(benchmark::State& state)
{
    const tbb::global_control two_cores(tbb::global_control::max_allowed_parallelism, 2);
    const Character character = makeCharacter();
    std::vector<GroupRecord> groups;
    std::vector<ClusterRecord> clusters(character.clusters.size());
    for (uint32_t i = 0; i < clusters.size(); ++i)
    {
        clusters[i].refined_group = kInvalidIndex;
        if (i % 16 == 0)
            groups.push_back({});
        groups.back().clusters = {i - i % 16, i % 16 + 1};
    }
    for (auto _ : state)
    {
        const AnimationTables tables = character.tables();
        const std::vector<animation_bounds::NodeMotion> nodes = animation_bounds::nodeMotions(tables);
        const std::vector<animation_bounds::Box3d> reach = computeReach(character);
        const animation_bounds::SkinMotion skin(tables, nodes, 0, reach);
        const animation_bounds::PoseRegions regions(tables, nodes);
        const skinning::Deformation deformation{&skin, {}, &regions};
        benchmark::DoNotOptimize(computeClusterBounds(character.clusters, deformation));
        benchmark::DoNotOptimize(
            computeAnchoredBounds({groups, clusters, 0, 0}, character.clusters, deformation, reach));
    }
    state.counters["vertices"] = kVertices;
    state.counters["joints"] = kJoints;
    state.counters["clips"] = kClips;
}
BENCHMARK(characterBounds)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
