// Compares the bounds of pose regions with poses in them: nodes, chains of joints, and the convergence of the
// bounds.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_bounds/region_chain.h"

#include "cook/animation_bounds/quaternion.h"
#include "cook/animation_bounds/slerp_model.h"
#include "tests/cook/animation/random_characters.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace hearth::animation_bounds
{

using namespace formats;

namespace
{

constexpr double kRounding = 1e-9;

template <size_t N>
std::array<double, N> valueAt(const TaylorModel<N>& model, const std::array<double, 3>& x)
{
    std::array<double, N> value{};
    for (size_t i = 0; i < N; ++i)
    {
        value[i] = model.terms[0][i];
        for (size_t a = 0; a < 3; ++a)
        {
            value[i] += model.terms[kFirstLinear + a][i] * x[a];
            for (size_t b = a; b < 3; ++b)
                value[i] += model.terms[termIndex(a, b)][i] * x[a] * x[b];
        }
    }
    return value;
}

Double3 vectorAt(const VectorModel& model, const std::array<double, 3>& x)
{
    const std::array<double, 3> value = valueAt(model, x);
    return {value[0], value[1], value[2]};
}

Double3 placeAt(const TransformModel& model, const std::array<double, 3>& x, Double3 point)
{
    const std::array<double, 9> m = valueAt(model.linear, x);
    const Double3 p = point - model.pivot;
    return vectorAt(model.place, x) + Double3{m[0] * p.x + m[1] * p.y + m[2] * p.z,
                                              m[3] * p.x + m[4] * p.y + m[5] * p.z,
                                              m[6] * p.x + m[7] * p.y + m[8] * p.z};
}

/// A scene, its regions, and poses in them.
class Regions
{
public:
    Regions(const test::CharacterSpec& spec, uint32_t seed)
        : random(seed),
          character(test::randomCharacter(spec, seed)),
          tables(character.tables()),
          nodes(nodeMotions(tables)),
          regions(tables, nodes),
          all(nodes.size()),
          from_(restPose(tables)),
          to_(from_),
          pose(from_)
    {
        std::iota(all.begin(), all.end(), 0u);
    }

    double uniform() { return std::uniform_real_distribution<double>(0, 1)(random); }

    /// Return a random region that subdivision of the root regions reaches.
    PoseRegion anyRegion(int most_cuts)
    {
        const std::vector<PoseRegion> roots = regions.all();
        PoseRegion region = roots[random() % roots.size()];
        for (int cuts = static_cast<int>(random() % static_cast<uint32_t>(most_cuts)); cuts > 0; --cuts)
            if (const auto split = regions.split(region, all))
                region = (*split)[random() % 2];
        return region;
    }

    /// Set `pose` to a pose in the region and return its parameters. Borders are as likely as the inside.
    std::array<double, 3> anyPose(const PoseRegion& region)
    {
        std::array<double, 3> x;
        for (double& parameter : x)
            parameter = random() % 4 == 0 ? (random() % 2 == 0 ? -1 : 1) : 2 * uniform() - 1;
        sample(region.from_clip, region.from_span, x[0], from_);
        sample(region.to_clip, region.to_span, x[1], to_);
        const double weight = std::lerp(region.low_weight, region.high_weight, 0.5 + 0.5 * x[2]);
        blendPoses(from_, to_, weight, pose);
        return x;
    }

    std::mt19937 random;
    test::Character character;
    AnimationTables tables;
    std::vector<NodeMotion> nodes;
    PoseRegions regions;
    std::vector<uint32_t> all;

private:
    void sample(uint32_t clip, uint32_t span, double& x, ScenePose& of_clip)
    {
        of_clip = restPose(tables);
        if (clip == 0)
            return;
        const TimeSpan time = regions.timeSpan(clip, span);
        // the next span begins exactly at the end, with a step
        const double share = time.last ? 0.5 + 0.5 * x : std::min(0.5 + 0.5 * x, 1 - 1e-9);
        x = 2 * share - 1;
        sampleAnimation(tables, tables.animations[clip - 1], std::lerp(time.from, time.to, share), of_clip);
    }

    ScenePose from_, to_;

public:
    ScenePose pose;
};

void checkNodes(const test::CharacterSpec& spec, uint32_t seed)
{
    Regions scene(spec, seed);
    for (int i = 0; i < 3000; ++i)
    {
        const PoseRegion region = scene.anyRegion(16);
        const std::array<double, 3> x = scene.anyPose(region);
        for (const uint32_t node : scene.all)
        {
            NodeModel model;
            scene.regions.setNodeModel(region, node, blendWeights(region.weights()), model);
            const NodePose& local = scene.pose.nodes[node];
            ASSERT_LE(length(vectorAt(model.translation, x) - local.translation),
                      model.translation.remainder + kRounding);
            ASSERT_LE(length(vectorAt(model.scale, x) - local.scale), model.scale.remainder + kRounding);
            const Quaternion rotation = valueAt(model.rotation, x);
            const double side = dot(rotation, local.rotation) < 0 ? -1 : 1;
            double square = 0;
            for (size_t c = 0; c < 4; ++c)
                square += std::pow(rotation[c] - side * local.rotation[c], 2);
            ASSERT_LE(std::sqrt(square), model.rotation.remainder + kRounding);
        }
    }
}

struct ChainFigures
{
    size_t points = 0;
    size_t unbounded = 0;
    double largest_share = 0; ///< used share of the slack
};

/// Points on all joints, relative to each third joint.
ChainFigures checkChains(const test::CharacterSpec& spec, uint32_t seed)
{
    Regions scene(spec, seed);
    const std::span<const JointRecord> joints = scene.tables.joints;
    std::vector<uint32_t> joint_nodes;
    for (const JointRecord& joint : joints)
        joint_nodes.push_back(joint.node);
    const std::vector<uint32_t> order = nodesParentsFirst(scene.tables.nodes);
    std::vector<Affine3d> world_from_node(scene.tables.nodes.size());
    std::vector<TransformModel> models;
    std::vector<uint32_t> all_joints(joint_nodes.size());
    std::iota(all_joints.begin(), all_joints.end(), 0u);
    ChainFigures figures;
    for (size_t main = 0; main < joint_nodes.size(); main += 3)
    {
        const RegionChain chain(scene.tables.nodes, joint_nodes[main], joint_nodes);
        const std::vector<uint32_t> links = chain.linksTo(all_joints);
        for (int i = 0; i < 60; ++i)
        {
            const PoseRegion region = scene.anyRegion(24);
            if (!chain.place(scene.regions, region, links, models))
            {
                ++figures.unbounded;
                continue;
            }
            for (int p = 0; p < 8; ++p)
            {
                const std::array<double, 3> x = scene.anyPose(region);
                poseNodes(scene.tables, scene.pose, order, world_from_node);
                const std::optional<Affine3d> main_from_world = inverted(world_from_node[joint_nodes[main]]);
                if (!main_from_world)
                    continue;
                for (uint32_t joint = 0; joint < joint_nodes.size(); ++joint)
                {
                    const Double3 point{scene.uniform() - 0.5, scene.uniform() - 0.5, scene.uniform() - 0.5};
                    const Affine3d seen = *main_from_world * world_from_node[joint_nodes[joint]];
                    const Double3 place = transformPoint(seen, point);
                    const TransformModel& model = models[chain.linkIndex(joint)];
                    const double off = length(place - placeAt(model, x, point));
                    const double slack = model.slackAt(point);
                    EXPECT_LE(off, slack + kRounding * (1 + length(place)));
                    if (slack > 1e-6)
                        figures.largest_share = std::max(figures.largest_share, off / slack);
                    ++figures.points;
                }
            }
        }
    }
    EXPECT_GT(figures.points, 1000u);
    return figures;
}

} // namespace

TEST(PoseRegions, holdTheirPoses)
{
    for (uint32_t seed = 1; seed <= 3; ++seed)
        checkNodes({.scale_low = 0.5, .scale_high = 1.5}, seed);
}

TEST(PoseRegions, holdPosesOfSplines)
{
    for (uint32_t seed = 1; seed <= 3; ++seed)
        checkNodes({.splines = true}, seed);
}

TEST(PoseRegions, holdPosesOfSpins)
{
    for (uint32_t seed = 1; seed <= 3; ++seed)
        checkNodes({.spins = true, .opposite = true}, seed);
}

TEST(PoseRegions, mirroredRegionsRepeatOthers)
{
    Regions scene({.clips = 1}, 5);
    const PoseRegion root{1, 1, 1, 1, 0, 1};
    const TimeSpan whole = scene.regions.timeSpan(1, 1);
    const auto contains = [&](uint32_t span, double time)
    {
        const TimeSpan span_time = scene.regions.timeSpan(1, span);
        return span_time.from <= time && (span_time.last ? time <= span_time.to : time < span_time.to);
    };
    size_t mirrored = 0, kept = 0;
    for (int i = 0; i < 3000; ++i)
    {
        // ends of spans, where keys are, as often as other times
        const auto anyTime = [&]
        {
            return scene.random() % 2 == 0 ? std::lerp(whole.from, whole.to, scene.uniform())
                                           : scene.regions.timeSpan(1, 1 + scene.random() % 15).from;
        };
        const double from = anyTime(), to = anyTime(), weight = scene.uniform();
        // follow the pose, or the same pose with times and weights exchanged, through the subdivision
        const auto follow = [&](double first, double second, double of_second)
        {
            PoseRegion region = root;
            while (!scene.regions.isMirrored(region))
            {
                const auto split = scene.regions.split(region, scene.all);
                if (!split)
                    return true;
                const PoseRegion& half = (*split)[0];
                const bool is_in_first = contains(half.from_span, first) && contains(half.to_span, second) &&
                                         of_second <= half.high_weight;
                region = (*split)[is_in_first ? 0 : 1];
            }
            return false;
        };
        const bool is_kept = follow(from, to, weight);
        ASSERT_TRUE(is_kept || follow(to, from, 1 - weight)) << from << " " << to << " " << weight;
        ++(is_kept ? kept : mirrored);
    }
    EXPECT_GT(mirrored, 1000u) << "nearly half of the regions";
    EXPECT_GT(kept, 1000u);
}

TEST(PoseRegions, differentClipsAreNotMirrored)
{
    Regions scene({.clips = 2}, 5);
    EXPECT_FALSE(scene.regions.isMirrored({1, 3, 2, 2, 0, 1}));
    EXPECT_TRUE(scene.regions.isMirrored({1, 3, 1, 2, 0, 1}));
    EXPECT_FALSE(scene.regions.isMirrored({1, 2, 1, 3, 0, 1}));
    EXPECT_FALSE(scene.regions.isMirrored({1, 2, 1, 2, 0, 1}));
    EXPECT_FALSE(scene.regions.isMirrored({0, 1, 0, 1, 0, 1})) << "the rest pose is a single time";
}

TEST(RegionChain, holdsWhatJointsDo)
{
    // the bound is useful: points come near to its border
    double largest_share = 0;
    for (uint32_t seed = 1; seed <= 4; ++seed)
        largest_share = std::max(largest_share, checkChains({}, seed).largest_share);
    EXPECT_GT(largest_share, 0.3);
}

TEST(RegionChain, holdsWhatSplinesAndScalesDo)
{
    for (uint32_t seed = 1; seed <= 4; ++seed)
        checkChains({.splines = true, .scale_low = 0.7, .scale_high = 1.4}, seed);
}

TEST(RegionChain, holdsWhatFastSpinsDo)
{
    for (uint32_t seed = 1; seed <= 4; ++seed)
        checkChains({.spins = true, .opposite = true}, seed);
}

TEST(RegionChain, holdsWhatMirrorsAndMatricesDo)
{
    for (uint32_t seed = 1; seed <= 4; ++seed)
        checkChains(
            {.scale_low = 0.5, .scale_high = 2, .mirrored = true, .matrices = true, .several_roots = true},
            seed);
}

TEST(RegionChain, hasNoBoundsWhereAScaleGoesThroughNothing)
{
    size_t unbounded = 0;
    for (uint32_t seed = 1; seed <= 4; ++seed)
        unbounded += checkChains({.scale_low = -0.5, .scale_high = 1}, seed).unbounded;
    EXPECT_GT(unbounded, 0u);
}

TEST(SlerpModel, holdsAllOfItsArcs)
{
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(0, 1);
    size_t known = 0;
    for (int i = 0; i < 3000; ++i)
    {
        // two geodesics, from very close to each other to the far side
        const auto any = [&](double size) {
            return Quaternion{size * normal(random), size * normal(random), size * normal(random), 1};
        };
        const double spread = std::pow(10, 1.5 * uniform(random) - 1.5);
        const double speed = std::pow(10, 2 * uniform(random) - 2.5);
        const Quaternion base = normalizedOrNone(any(1));
        const auto arc = [&]
        {
            const Quaternion start = multiply(base, normalizedOrNone(any(spread)));
            const std::vector<float> keys = [&]
            {
                std::vector<float> numbers{0, 1};
                const Quaternion end = multiply(start, normalizedOrNone(any(speed)));
                for (const Quaternion& q : {start, end})
                    for (const double number : q)
                        numbers.push_back(static_cast<float>(number));
                return numbers;
            }();
            return keys;
        };
        AnimationChannelRecord channel{};
        channel.interpolation = static_cast<uint32_t>(Interpolation::linear);
        channel.components = 4;
        channel.key_count = 2;
        channel.first_value = 2;
        const std::vector<float> keys[2] = {arc(), arc()};
        const Interval weights = [&]
        {
            Interval range;
            range.add(uniform(random));
            range.add(random() % 4 == 0 ? 1.0 : uniform(random));
            return range;
        }();
        const auto curve = [&](std::span<const float> numbers)
        {
            AnimationTables tables{};
            tables.keys = numbers;
            return fitRotationCurve({0, 1, true}, tables, channel);
        };
        TaylorModel<4> model;
        BlendWeights blend(weights);
        slerpModel(curve(keys[0]), curve(keys[1]), blend, model);
        known += model.remainder < 0.5 ? 1 : 0;
        for (int p = 0; p < 20; ++p)
        {
            std::array<double, 3> x;
            for (double& parameter : x)
                parameter = random() % 4 == 0 ? (random() % 2 == 0 ? -1 : 1) : 2 * uniform(random) - 1;
            Quaternion ends[2];
            for (size_t end = 0; end < 2; ++end)
            {
                const auto key = [&](size_t at)
                {
                    const float* const q = &keys[end][2 + 4 * at];
                    return normalizedOrNone({q[0], q[1], q[2], q[3]});
                };
                ends[end] = slerp(key(0), key(1), 0.5 + 0.5 * x[end]);
            }
            const Quaternion q =
                slerp(ends[0], ends[1], std::lerp(weights.low, weights.high, 0.5 + 0.5 * x[2]));
            const Quaternion said = valueAt(model, x);
            const double side = dot(said, q) < 0 ? -1 : 1;
            double square = 0;
            for (size_t c = 0; c < 4; ++c)
                square += std::pow(said[c] - side * q[c], 2);
            ASSERT_LE(std::sqrt(square), model.remainder + kRounding)
                << "spread " << spread << ", speed " << speed;
        }
    }
    EXPECT_GT(known, 2000u);
}

TEST(RegionChain, slackFallsWithThirdOrderInSmoothClips)
{
    // one key interval: only the size of the region causes slack
    Regions scene({.clips = 2, .keys = 2, .swing = 0.3}, 3);
    std::vector<uint32_t> joint_nodes;
    for (const JointRecord& joint : scene.tables.joints)
        joint_nodes.push_back(joint.node);
    const RegionChain chain(scene.tables.nodes, joint_nodes[0], joint_nodes);
    const std::vector<uint32_t> last_joint{static_cast<uint32_t>(joint_nodes.size() - 1)};
    const std::vector<uint32_t> links = chain.linksTo(last_joint);
    ASSERT_GT(links.size(), 1u);
    std::vector<TransformModel> models;
    double last = 0;
    for (uint32_t depth = 2; depth < 6; ++depth)
    {
        const uint32_t span = 1u << depth;
        const double weights = 1.0 / span;
        ASSERT_TRUE(chain.place(scene.regions, {1, span, 2, span, 0.25, 0.25 + weights}, links, models));
        const double slack = models[chain.linkIndex(last_joint[0])].slackAt({0.2, 0.2, 0.2});
        if (depth > 2)
        {
            EXPECT_GT(last / slack, 6) << depth << ": " << slack;
        }
        last = slack;
    }
}

} // namespace hearth::animation_bounds
