// Tests the bounds of deformed clusters with clips made to break them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/cluster_frame.h"
#include "cook/skinning/group_spheres.h"
#include "tests/cook/animation/limb_character.h"
#include "tests/support/sanitized.h"

#include <cmath>
#include <gtest/gtest.h>
#include <tuple>

namespace hearth::skinning
{

using namespace formats;
using test::BoundsFigures;
using test::Character;
using test::CharacterSpec;

namespace
{

BoundsFigures measureBounds(const CharacterSpec& spec, uint32_t seeds = 1, size_t poses = 2000)
{
    BoundsFigures figures;
    for (uint32_t seed = 1; seed <= seeds; ++seed)
    {
        Character character = test::randomCharacter(spec, seed);
        test::computeBounds(character.tables(), character.mesh);
        figures += test::checkBounds(character.tables(), character.mesh, test::trials(poses), seed);
    }
    return figures;
}

void expectSound(const BoundsFigures& figures)
{
    EXPECT_EQ(figures.violations, 0u) << "by up to " << figures.worst;
    EXPECT_EQ(figures.facing_wrong, 0u);
    std::printf("%zu clusters, %zu with cones, volume %.3f x the tightest box\n", figures.clusters,
                figures.cones, figures.volume_ratio / static_cast<double>(figures.clusters));
}

} // namespace

TEST(DeformedBounds, holdOrdinaryClips)
{
    expectSound(measureBounds({}));
}

TEST(DeformedBounds, holdSmallMotionsWithCones)
{
    const BoundsFigures figures = measureBounds({.swing = 0.05, .influences = 2});
    expectSound(figures);
    EXPECT_GT(figures.cones, 0u) << "a cone that is always given up holds nothing";
    EXPECT_LE(figures.volume_ratio / static_cast<double>(figures.clusters), 1.5);
}

TEST(DeformedBounds, holdFastSpins)
{
    expectSound(measureBounds({.spins = true}));
}

TEST(DeformedBounds, holdOppositeQuaternions)
{
    expectSound(measureBounds({.swing = 1.5, .opposite = true}));
}

TEST(DeformedBounds, holdSplinesThatOvershoot)
{
    expectSound(measureBounds({.splines = true}));
}

TEST(DeformedBounds, holdScales)
{
    expectSound(measureBounds({.scale_low = 0.5, .scale_high = 2}));
}

TEST(DeformedBounds, holdScalesThatGoThroughNothing)
{
    expectSound(measureBounds({.scale_low = -0.5, .scale_high = 1}));
}

TEST(DeformedBounds, holdMirroredJointsAndMatrices)
{
    expectSound(measureBounds({.mirrored = true, .matrices = true, .several_roots = true}));
}

TEST(DeformedBounds, holdTwoHundredJoints)
{
    expectSound(measureBounds({.joints = 200, .influences = 8, .far_influences = true}, 1, 400));
}

TEST(DeformedBounds, holdMorphTargets)
{
    expectSound(measureBounds({.splines = true, .morph_targets = 5}));
}

TEST(DeformedBounds, holdFreePosesWithAnyMorphWeights)
{
    std::mt19937 random(7);
    const auto value = [&](double most)
    { return std::uniform_real_distribution<double>(-most, most)(random); };
    Character character = test::randomCharacter({.morph_targets = 4, .far_influences = true}, 3);
    test::computeBounds(character.tables(), character.mesh);
    const auto joints = static_cast<uint32_t>(character.joints.size());
    size_t vertices = 0, beyond_unmorphed = 0;
    double nearest = 1;
    for (size_t pose = 0; pose < test::trials(1000); ++pose)
    {
        std::vector<Affine3d> palette(joints);
        for (Affine3d& joint : palette)
            for (auto& row : joint.m)
                for (double& cell : row)
                    cell = value(2);
        const double most = pose % 2 == 0 ? 1 : 5;
        const double weights[] = {value(most), value(most), value(most), value(most)};
        const double stretch = std::max(
            {std::abs(weights[0]), std::abs(weights[1]), std::abs(weights[2]), std::abs(weights[3])});
        for (size_t c = 0; c < character.mesh.clusters.size(); ++c)
        {
            const DeformedCluster& cluster = character.mesh.clusters[c];
            animation_bounds::Box3d bind;
            for (const Float3 position : cluster.positions)
                animation_bounds::add(bind, widen(position));
            const double grown = stretch * double{character.mesh.bounds[c].morph_reach};
            // as in formats/FORMAT.md: the union over the joints of the grown and transformed box
            const auto carried = [&](double by)
            {
                animation_bounds::Box3d all;
                for (const uint16_t joint : cluster.joints)
                    for (int corner = 0; corner < 8; ++corner)
                        animation_bounds::add(
                            all, transformPoint(palette[joint],
                                                {(corner & 1) != 0 ? bind[0].high + by : bind[0].low - by,
                                                 (corner & 2) != 0 ? bind[1].high + by : bind[1].low - by,
                                                 (corner & 4) != 0 ? bind[2].high + by : bind[2].low - by}));
                return all;
            };
            const animation_bounds::Box3d bound = carried(grown), unmorphed = carried(0);
            for (size_t v = 0; v < cluster.positions.size(); ++v, ++vertices)
            {
                Double3 place = widen(cluster.positions[v]);
                for (const MorphDeltas& morph : cluster.morphs)
                    place = place + widen(morph.positions[v]) * weights[morph.target];
                for (const auto& [position, low, high] : {std::tuple{place.x, bind[0].low, bind[0].high},
                                                          {place.y, bind[1].low, bind[1].high},
                                                          {place.z, bind[2].low, bind[2].high}})
                    nearest = std::min(
                        nearest,
                        grown == 0 ? 1 : std::min(position - (low - grown), high + grown - position) / grown);
                Double3 skinned;
                for (size_t i = 0; i < cluster.influences; ++i)
                    skinned =
                        skinned + transformPoint(palette[cluster.joints[v * cluster.influences + i]], place) *
                                      cluster.weights[v * cluster.influences + i];
                constexpr double kRounding = 1e-9;
                for (const auto& [axis, position] :
                     {std::pair<size_t, double>{0, skinned.x}, {1, skinned.y}, {2, skinned.z}})
                {
                    EXPECT_GE(position, bound[axis].low - kRounding);
                    EXPECT_LE(position, bound[axis].high + kRounding);
                    beyond_unmorphed += unmorphed[axis].contains(position) ? 0u : 1u;
                }
            }
        }
    }
    EXPECT_GT(vertices, test::kSanitized ? 4000u : 100000u);
    EXPECT_GT(beyond_unmorphed, test::kSanitized ? 20u : 100u)
        << "without the targets' reach the bound would not hold";
    EXPECT_LT(nearest, 0.3) << "nothing uses the reach";
}

TEST(DeformedBounds, morphTargetsAloneAreTight)
{
    BoundsFigures figures;
    for (uint32_t seed = 1; seed <= 4; ++seed)
    {
        Character character = test::randomCharacter({.clips = 2, .morph_targets = 4}, seed);
        character.nodes[character.mesh.node].skin = character.mesh.skin = kInvalidIndex;
        for (DeformedCluster& cluster : character.mesh.clusters)
        {
            cluster.influences = 0;
            cluster.joints.clear();
            cluster.weights.clear();
        }
        test::computeBounds(character.tables(), character.mesh);
        figures += test::checkBounds(character.tables(), character.mesh, test::trials(2000), seed);
    }
    expectSound(figures);
}

TEST(DeformedBounds, whatIsRigidKeepsItsBoxAndCone)
{
    Character character = test::randomCharacter({.influences = 1}, 4);
    test::computeBounds(character.tables(), character.mesh);
    for (size_t i = 0; i < character.mesh.clusters.size(); ++i)
    {
        Box3 box;
        for (const Float3 p : character.mesh.clusters[i].positions)
            box.add(p);
        const DeformedClusterRecord& record = character.mesh.bounds[i];
        EXPECT_LE(length(record.box_min - box.min), 1e-5f);
        EXPECT_LE(length(record.box_max - box.max), 1e-5f);
        EXPECT_NE(record.cone_cutoff, kNoCone);
        EXPECT_EQ(record.joint, character.mesh.clusters[i].joints[0]);
    }
}

TEST(DeformedBounds, withoutAJointThatKeepsItsSizeThereIsNoBox)
{
    Character character = test::randomCharacter({.joints = 3, .clips = 0, .influences = 3}, 4);
    for (NodeRecord& node : character.nodes)
        node.scale = {0, 0, 0};
    for (NodeRecord& node : character.nodes)
        node.parent = kInvalidIndex;
    for (DeformedCluster& cluster : character.mesh.clusters)
        for (size_t i = 0; i < cluster.joints.size(); ++i)
        {
            cluster.joints[i] = static_cast<uint16_t>(i % 3);
            cluster.weights[i] = 1.0 / 3;
        }
    test::computeBounds(character.tables(), character.mesh);
    for (size_t i = 0; i < character.mesh.clusters.size(); ++i)
    {
        const DeformedClusterRecord& record = character.mesh.bounds[i];
        EXPECT_EQ(record.box_max.x, kUnbounded);
        EXPECT_EQ(record.cone_cutoff, kNoCone);
    }
}

TEST(DeformedBounds, jointsThatMoveTogetherGiveTightBoxes)
{
    // a long chain whose joints can each turn far, but the only clip turns all of them together, there and
    // back
    Character character = test::randomCharacter({.joints = 8, .clips = 0, .influences = 4}, 3);
    for (uint32_t joint = 0; joint < 8; ++joint)
    {
        character.nodes[joint].parent = joint == 0 ? kInvalidIndex : joint - 1;
        AnimationChannelRecord channel{};
        channel.target = joint;
        channel.path = static_cast<uint32_t>(AnimationPath::rotation);
        channel.interpolation = static_cast<uint32_t>(Interpolation::linear);
        channel.components = 4;
        channel.key_count = 2;
        channel.first_time = static_cast<uint32_t>(character.keys.size());
        character.keys.insert(character.keys.end(), {0, 1});
        channel.first_value = static_cast<uint32_t>(character.keys.size());
        const Float4 rest = character.nodes[joint].rotation;
        const float turn = joint % 2 == 0 ? 0.3f : -0.3f;
        character.keys.insert(character.keys.end(), {rest.x, rest.y, rest.z, rest.w});
        character.keys.insert(character.keys.end(), {rest.x, rest.y + turn, rest.z, rest.w});
        character.channels.push_back(channel);
    }
    character.animations.push_back({{}, {0, 8}, {8, 0}, 1, 0});
    for (AnimationChannelRecord& channel : character.channels)
    {
        // of length 1
        float* const end = &character.keys[channel.first_value + 4];
        const float l = std::sqrt(end[0] * end[0] + end[1] * end[1] + end[2] * end[2] + end[3] * end[3]);
        for (size_t i = 0; i < 4; ++i)
            end[i] /= l;
    }
    test::computeBounds(character.tables(), character.mesh);
    const BoundsFigures figures =
        test::checkBounds(character.tables(), character.mesh, test::trials(3000), 1);
    expectSound(figures);
    EXPECT_LE(figures.volume_ratio / static_cast<double>(figures.clusters), 1.6);
}

TEST(DeformedBounds, ofLargeCharactersAreTight)
{
    Character character = test::limbCharacter({test::kSanitized ? 8'000u : 100'000u, 4, 20});
    test::computeBounds(character.tables(), character.mesh);
    const BoundsFigures figures =
        test::checkBounds(character.tables(), character.mesh, test::kSanitized ? 200 : 2000, 1);
    expectSound(figures);
    std::printf("volume of all boxes %.3f x that of the tightest ones\n",
                figures.volume / figures.tightest_volume);
    EXPECT_LE(figures.volume / figures.tightest_volume, test::kSanitized ? 3 : 1.6);
}

TEST(ClusterFrame, takesWhatAllVerticesHaveInCommon)
{
    // a far joint moves all vertices by a tenth, a near one some of them
    Character character = test::limbCharacter({1'000, 4, 2});
    DeformedCluster& cluster = character.mesh.clusters.front();
    character.mesh.clusters.resize(1);
    for (size_t v = 0; v < cluster.positions.size(); ++v)
    {
        const double near = v % 2 == 0 ? 0.3 : 0.0;
        const uint16_t joints[] = {0, 1, 9, 0};
        const double weights[] = {0.9 - near, near, 0.1, 0};
        for (size_t i = 0; i < 4; ++i)
        {
            cluster.joints[4 * v + i] = joints[i];
            cluster.weights[4 * v + i] = weights[i];
        }
    }
    test::computeBounds(character.tables(), character.mesh);
    const std::vector<uint32_t>& joints = character.mesh.joints.front();
    ASSERT_EQ(joints.size(), 3u);
    EXPECT_EQ(joints[0], 0u) << "the main bone, which has the rest";
    EXPECT_EQ(jointIndex(joints[1]), 9u);
    EXPECT_EQ(jointShare(joints[1]), 6553u) << "a tenth, rounded down";
    EXPECT_EQ(joints[2], 1u) << "not all vertices follow this one";
    expectSound(test::checkBounds(character.tables(), character.mesh, test::trials(2000), 1));
}

TEST(ClusterFrame, boundsTheDistanceToWhatRemains)
{
    const Character character = test::limbCharacter({2'000, 8, 4});
    const AnimationTables tables = character.tables();
    const std::vector<animation_bounds::NodeMotion> nodes = animation_bounds::nodeMotions(tables);
    const std::vector<animation_bounds::Box3d> reach(60,
                                                     {animation_bounds::Interval{-1, 1}, {-1, 1}, {-1, 1}});
    const animation_bounds::SkinMotion skin(tables, nodes, 0, reach);
    const Deformation deformation{&skin, {}};
    test::PoseSource source(tables, 5);
    double largest_share = 0;
    for (const DeformedCluster& cluster : character.mesh.clusters)
    {
        const uint32_t main = cluster.joints[0];
        const ClusterFrame frame(main, cluster, deformation);
        ASSERT_FALSE(frame.shares().empty());
        const DeformedCluster rest = frame.remainder(cluster);
        std::vector<animation_bounds::Box3d> places(cluster.positions.size());
        std::vector<Double3> farthest(cluster.positions.size());
        for (size_t pose = 0; pose < test::trials(300); ++pose)
        {
            source.next();
            const std::vector<Affine3d> palette = source.palette(0, 0);
            Affine3d world_from_frame = palette[main];
            for (const FrameShare& share : frame.shares())
                for (size_t row = 0; row < 3; ++row)
                    for (size_t column = 0; column < 4; ++column)
                        world_from_frame.m[row][column] +=
                            share.share / 65536.0 *
                            (palette[share.joint].m[row][column] - palette[main].m[row][column]);
            const auto skinned = [&](const DeformedCluster& by, size_t v)
            {
                Double3 place;
                for (size_t i = v * by.influences; i < (v + 1) * by.influences; ++i)
                    place =
                        place + transformPoint(palette[by.joints[i]], widen(by.positions[v])) * by.weights[i];
                return place;
            };
            const Affine3d frame_from_world = *inverted(world_from_frame),
                           main_from_world = *inverted(palette[main]);
            for (size_t v = 0; v < places.size(); ++v)
            {
                const Double3 remaining = transformPoint(main_from_world, skinned(rest, v));
                const Double3 off = transformPoint(frame_from_world, skinned(cluster, v)) - remaining;
                add(places[v], remaining);
                farthest[v] = {std::max(farthest[v].x, std::abs(off.x)),
                               std::max(farthest[v].y, std::abs(off.y)),
                               std::max(farthest[v].z, std::abs(off.z))};
            }
        }
        for (size_t v = 0; v < places.size(); ++v)
        {
            const Double3 bound = frame.distance(widen(cluster.positions[v]), places[v]);
            constexpr double kRounding = 1e-9;
            EXPECT_LE(farthest[v].x, bound.x + kRounding);
            EXPECT_LE(farthest[v].y, bound.y + kRounding);
            EXPECT_LE(farthest[v].z, bound.z + kRounding);
            largest_share = std::max(
                {largest_share, farthest[v].x / bound.x, farthest[v].y / bound.y, farthest[v].z / bound.z});
        }
    }
    EXPECT_GT(largest_share, 0.2) << "a bound that nothing comes near to holds nothing";
}

TEST(AnchoredBounds, spheresHoldThoseOfRefinedGroups)
{
    Character character = test::randomCharacter({}, 7);
    const AnimationTables tables = character.tables();
    const std::vector<animation_bounds::NodeMotion> nodes = animation_bounds::nodeMotions(tables);
    const std::vector<animation_bounds::Box3d> reach(12,
                                                     {animation_bounds::Interval{-1, 1}, {-1, 1}, {-1, 1}});
    const animation_bounds::SkinMotion skin(tables, nodes, 0, reach);
    const Deformation deformation{&skin, {}};
    // a root of two clusters, the second made from a set of two groups
    const auto group = [](Range clusters, uint32_t set_offset)
    {
        GroupRecord record{};
        record.clusters = clusters;
        record.set_offset = set_offset;
        return record;
    };
    const std::vector<GroupRecord> groups{group({5, 2}, 0), group({7, 3}, 0), group({10, 2}, 1)};
    std::vector<ClusterRecord> clusters(7);
    for (ClusterRecord& cluster : clusters)
        cluster.refined_group = kInvalidIndex;
    clusters[1].refined_group = 21;
    std::vector<DeformedCluster> deformed;
    for (size_t i = 0; i < clusters.size(); ++i)
        deformed.push_back(character.mesh.clusters[i % character.mesh.clusters.size()]);
    const AnchoredBounds bounds =
        computeAnchoredBounds({groups, clusters, 20, 5}, deformed, deformation, reach);
    ASSERT_EQ(bounds.spheres.size(), 3u);
    EXPECT_EQ(bounds.spheres[1].center, bounds.spheres[2].center);
    EXPECT_EQ(bounds.spheres[1].radius, bounds.spheres[2].radius);
    EXPECT_LE(length(bounds.spheres[1].center - bounds.spheres[0].center) + bounds.spheres[1].radius,
              bounds.spheres[0].radius);
}

} // namespace hearth::skinning
