// Tests the reported displacement of vertices whose weakest skinning influences are dropped: it is an upper
// bound.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/influence_displacement.h"

#include "cook/animation_bounds/symmetric.h"
#include "cook/clusters/core/hierarchy.h"
#include "cook/mesh/deformation.h"
#include "tests/cook/animation/random_characters.h"
#include "tests/support/sanitized.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace hearth::test
{

namespace
{

using clusters::MeshMotion;

/// Vertices of a character's clusters, its weights in sets of four, and triangles between any of the
/// vertices.
mesh::SourceMesh makeMesh(const Character& character)
{
    mesh::SourceMesh mesh;
    for (const skinning::DeformedCluster& cluster : character.mesh.clusters)
    {
        const size_t first = mesh.vertexCount();
        const size_t sets = (cluster.influences + 3) / 4;
        mesh.positions.insert(mesh.positions.end(), cluster.positions.begin(), cluster.positions.end());
        mesh.joint_sets.resize(sets);
        mesh.weight_sets.resize(sets);
        for (size_t set = 0; set < sets; ++set)
            for (size_t v = 0; v < cluster.positions.size(); ++v)
            {
                mesh::Joints4 joints{};
                float weights[4] = {};
                for (size_t i = 0; i < 4 && set * 4 + i < cluster.influences; ++i)
                {
                    joints.joint[i] = cluster.joints[v * cluster.influences + set * 4 + i];
                    weights[i] = static_cast<float>(cluster.weights[v * cluster.influences + set * 4 + i]);
                }
                mesh.joint_sets[set].push_back(joints);
                mesh.weight_sets[set].push_back({weights[0], weights[1], weights[2], weights[3]});
            }
        for (const uint32_t index : cluster.indices)
            mesh.indices.push_back(static_cast<uint32_t>(first) + index);
        mesh.morph_targets.resize(cluster.morphs.size());
        for (const skinning::MorphDeltas& morph : cluster.morphs)
            mesh.morph_targets[morph.target].positions.insert(
                mesh.morph_targets[morph.target].positions.end(), morph.positions.begin(),
                morph.positions.end());
    }
    mesh.triangle_materials.assign(mesh.triangleCount(), kInvalidIndex);
    return mesh;
}

std::vector<animation_bounds::Box3d> computeReach(const mesh::SourceMesh& mesh, size_t joints)
{
    std::vector<animation_bounds::Box3d> reach(joints);
    for (const auto& set : mesh.joint_sets)
        for (size_t v = 0; v < mesh.vertexCount(); ++v)
            for (const uint16_t joint : set[v].joint)
                animation_bounds::add(reach[joint], widen(mesh.positions[v]));
    return reach;
}

Double3 posedVertex(const mesh::SourceMesh& mesh, size_t v, Double3 bind, std::span<const Affine3d> palette)
{
    Double3 place;
    double sum = 0;
    for (size_t set = 0; set < mesh.joint_sets.size(); ++set)
    {
        const Float4 w = mesh.weight_sets[set][v];
        const float weights[4] = {w.x, w.y, w.z, w.w};
        for (size_t i = 0; i < 4; ++i)
        {
            place =
                place + transformPoint(palette[mesh.joint_sets[set][v].joint[i]], bind) * double{weights[i]};
            sum += double{weights[i]};
        }
    }
    return place * (1 / sum);
}

std::set<uint16_t> getJoints(const mesh::SourceMesh& mesh, size_t v)
{
    std::set<uint16_t> joints;
    for (size_t set = 0; set < mesh.joint_sets.size(); ++set)
    {
        const Float4 w = mesh.weight_sets[set][v];
        const float weights[4] = {w.x, w.y, w.z, w.w};
        for (size_t i = 0; i < 4; ++i)
            if (weights[i] > 0)
                joints.insert(mesh.joint_sets[set][v].joint[i]);
    }
    return joints;
}

/// Return the maximum distance, over vertices that lost a joint, between their positions in `kept` and in
/// `all` in one pose, relative to the largest stretch of the pose's joints.
double measured(const Character& character, const mesh::SourceMesh& all, const mesh::SourceMesh& kept,
                int poses, uint32_t seed)
{
    std::vector<size_t> displaced;
    for (size_t v = 0; v < kept.vertexCount(); ++v)
        if (getJoints(kept, v) != getJoints(all, v))
            displaced.push_back(v);
    PoseSource source(character.tables(), seed);
    double most = 0;
    for (int i = 0; i < poses; ++i)
    {
        const formats::ScenePose& pose = source.next();
        const std::vector<Affine3d> palette = source.palette(0, character.mesh.node);
        double scale = 0;
        for (const Affine3d& joint : palette)
            scale = std::max(scale, animation_bounds::operatorNorm(joint));
        const formats::Range weights = character.nodes[character.mesh.node].morph_weights;
        for (const size_t v : displaced)
        {
            Double3 bind = widen(kept.positions[v]);
            for (uint32_t target = 0; target < kept.morph_targets.size(); ++target)
                bind = bind + widen(kept.morph_targets[target].positions[v]) *
                                  static_cast<double>(pose.morph_weights[weights.first + target]);
            most = std::max(most,
                            length(posedVertex(all, v, bind, palette) - posedVertex(kept, v, bind, palette)) /
                                scale);
        }
    }
    return most;
}

/// Return the reported displacement for a character whose vertices keep four influences.
struct Reduced
{
    explicit Reduced(const Character& character)
        : all(makeMesh(character)),
          kept(all),
          tables(character.tables()),
          nodes(animation_bounds::nodeMotions(tables)),
          skin(tables, nodes, 0, computeReach(all, tables.skins[0].joints.count)),
          motion{&skin, {}}
    {
        mesh::reduceInfluences(kept, 4);
        for (const animation_bounds::Interval& range :
             animation_bounds::morphWeightRanges(tables, character.mesh.node, all.morph_targets.size()))
            motion.max_morph_weights.push_back(static_cast<float>(std::max(range.magnitude(), 1.0)));
        reported = clusters::influenceDisplacement(all, kept, motion);
    }
    Reduced(const Reduced&) = delete;

    mesh::SourceMesh all, kept;
    formats::AnimationTables tables;
    std::vector<animation_bounds::NodeMotion> nodes;
    animation_bounds::SkinMotion skin;
    MeshMotion motion;
    std::optional<double> reported;
};

Affine3 shifted(float y)
{
    Affine3 transform;
    transform.m[1][3] = y;
    return transform;
}

/// Six joints in a row, half a metre apart; one clip bends each by a third of a radian, all in the same
/// direction. Every vertex has all six as influences.
Character bentTail()
{
    constexpr uint32_t kJoints = 6;
    Character character;
    for (uint32_t i = 0; i <= kJoints; ++i)
    {
        formats::NodeRecord node{};
        node.parent = i == 0 || i == kJoints ? kInvalidIndex : i - 1;
        node.mesh = i == kJoints ? 0 : kInvalidIndex;
        node.skin = i == kJoints ? 0 : kInvalidIndex;
        node.has_trs = 1;
        node.translation = {0, i == 0 || i == kJoints ? 0.0f : 0.5f, 0};
        node.rotation = {0, 0, 0, 1};
        node.scale = {1, 1, 1};
        node.parent_from_node = shifted(node.translation.y);
        character.nodes.push_back(node);
        if (i < kJoints)
            character.joints.push_back({i, {}, shifted(-0.5f * static_cast<float>(i))});
    }
    character.skins.push_back({{}, kInvalidIndex, {0, kJoints}, 0});
    character.mesh.node = kJoints;
    character.mesh.skin = 0;
    character.keys = {0, 1, 0, 0, 0, 1, 0, 0, std::sin(1.0f / 6), std::cos(1.0f / 6)};
    for (uint32_t i = 0; i < kJoints; ++i)
    {
        formats::AnimationChannelRecord channel{};
        channel.target = i;
        channel.path = static_cast<uint32_t>(formats::AnimationPath::rotation);
        channel.interpolation = static_cast<uint32_t>(formats::Interpolation::linear);
        channel.components = 4;
        channel.key_count = 2;
        channel.first_value = 2;
        character.channels.push_back(channel);
    }
    character.animations.push_back({{}, {0, kJoints}, {kJoints, 0}, 1, 0});
    skinning::DeformedCluster cluster;
    cluster.influences = kJoints;
    for (uint32_t v = 0; v < 24; ++v)
    {
        const float height = 0.1f * static_cast<float>(v);
        cluster.positions.push_back({v % 2 == 0 ? 0.1f : -0.1f, height, 0});
        double sum = 0;
        for (uint32_t i = 0; i < kJoints; ++i)
        {
            cluster.joints.push_back(static_cast<uint16_t>(i));
            cluster.weights.push_back(std::exp(-std::abs(double{height} / 0.5 - i)));
            sum += cluster.weights.back();
        }
        for (uint32_t i = 0; i < kJoints; ++i)
            cluster.weights[v * kJoints + i] /= sum;
    }
    cluster.indices = {0, 1, 2};
    character.mesh.clusters.push_back(cluster);
    return character;
}

constexpr double kRounding = 1e-6; // metres: weights are floats

} // namespace

TEST(InfluenceDisplacement, boundsWhatPosesShowWhateverTheClipsDo)
{
    const CharacterSpec specs[] = {
        {.influences = 8},
        {.influences = 11, .far_influences = true},
        {.swing = 3, .influences = 8, .far_influences = true},
        {.splines = true, .influences = 8},
        {.spins = true, .opposite = true, .influences = 8},
        {.scale_low = 0.3, .scale_high = 2, .influences = 8},
        {.mirrored = true, .influences = 12, .far_influences = true},
        {.matrices = true, .several_roots = true, .influences = 8, .far_influences = true},
        {.splines = true, .morph_targets = 3, .influences = 8},
    };
    uint32_t seed = 0, displaced = 0;
    for (const CharacterSpec& spec : specs)
        for (int i = 0; i < 4; ++i, ++seed)
        {
            SCOPED_TRACE("seed " + std::to_string(seed));
            const Character character = randomCharacter(spec, seed);
            const Reduced reduced(character);
            ASSERT_TRUE(reduced.reported);
            const double most = measured(character, reduced.all, reduced.kept, trials(400), seed);
            EXPECT_LE(most, *reduced.reported + kRounding);
            displaced += most > 1e-3 ? 1 : 0;
        }
    EXPECT_GT(displaced, 30u);
}

TEST(InfluenceDisplacement, isNotFarAboveWhatPosesShowOfASimpleBend)
{
    const Character character = bentTail();
    const Reduced reduced(character);
    ASSERT_TRUE(reduced.reported);
    const double most = measured(character, reduced.all, reduced.kept, trials(2000), 1);
    std::printf("a tail that bends: %.4f m reported, %.4f m measured\n", *reduced.reported, most);
    EXPECT_LE(most, *reduced.reported + kRounding);
    EXPECT_LE(*reduced.reported, 3 * most);
}

TEST(InfluenceDisplacement, isAPlausibleMultipleOfWhatPosesShowOfLimbs)
{
    double worst = 0;
    for (uint32_t seed = 0; seed < 8; ++seed)
    {
        const Character character = randomCharacter({.joints = 8, .clips = 2, .influences = 6}, seed);
        const Reduced reduced(character);
        ASSERT_TRUE(reduced.reported);
        const double most = measured(character, reduced.all, reduced.kept, trials(4000), seed);
        worst = std::max(worst, *reduced.reported / most);
    }
    std::printf("limbs: reported at most %.2f of what is measured\n", worst);
    EXPECT_LE(worst, 6);
}

TEST(InfluenceDisplacement, isNothingWhereAllInfluencesAreKept)
{
    const Character character = randomCharacter({.influences = 4}, 5);
    EXPECT_EQ(Reduced(character).reported, 0.0);
}

TEST(InfluenceDisplacement, standsAmongTheCountsOfTheBuild)
{
    const Character character = randomCharacter({.influences = 8}, 6);
    const Reduced reduced(character);
    clusters::Config config;
    config.influences = 4;
    const clusters::Hierarchy hierarchy = clusters::buildHierarchy(reduced.all, config, &reduced.motion);
    EXPECT_GT(hierarchy.counts.influence_loss.vertex_count, 0u);
    EXPECT_EQ(hierarchy.counts.influence_displacement, reduced.reported);
    const clusters::Hierarchy whole = clusters::buildHierarchy(reduced.all, {}, &reduced.motion);
    EXPECT_EQ(whole.counts.influence_displacement, 0.0);
    EXPECT_FALSE(clusters::buildHierarchy(reduced.all, config).counts.influence_displacement)
        << "nobody knows how it moves";
}

} // namespace hearth::test
