// Compares bounds on the motion of joints over all clips with their motion in sampled poses.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_bounds/skin_motion.h"

#include "cook/animation_bounds/quaternion.h"
#include "tests/cook/animation/random_characters.h"

#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

namespace hearth::animation_bounds
{

using namespace formats;

namespace
{

constexpr double kRounding = 1e-9;

Quaternion turn(Double3 axis, double angle)
{
    const double sine = std::sin(angle / 2) / length(axis);
    return {axis.x * sine, axis.y * sine, axis.z * sine, std::cos(angle / 2)};
}

Double3 direction(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    const Double3 v{normal(random), normal(random), normal(random)};
    return v * (1 / length(v));
}

/// Return the distance of a rotation outside of the hull, tested along `count` directions.
double measureOutside(const RotationHull& hull, const Quaternion& q, std::mt19937& random, int count = 20)
{
    const Affine3d r = makeAffineFromTrs({}, q, {1, 1, 1});
    double worst = -1;
    for (int i = 0; i < count; ++i)
    {
        const Double3 a = direction(random), x = direction(random);
        double reach = -1e30;
        for (const Matrix3& m : hull.matrices)
        {
            const Double3 y{m[0][0] * x.x + m[0][1] * x.y + m[0][2] * x.z,
                            m[1][0] * x.x + m[1][1] * x.y + m[1][2] * x.z,
                            m[2][0] * x.x + m[2][1] * x.y + m[2][2] * x.z};
            reach = std::max(reach, dot(a, y));
        }
        worst = std::max(worst, dot(a, transformVector(r, x)) - reach - hull.slack);
    }
    return worst;
}

/// Return a blend of blends of the points.
Quaternion anyBlend(const RotationPoints& points, std::mt19937& random)
{
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto any = [&] { return normalizedOrNone(points.points[random() % points.points.size()]); };
    const Quaternion a = slerp(any(), any(), uniform(random));
    const Quaternion b = slerp(any(), any(), uniform(random));
    return slerp(a, b, uniform(random));
}

RotationPoints pointsAround(std::mt19937& random, double swing, bool one_axis)
{
    const Quaternion center = turn(direction(random), 1.7);
    const Double3 axis = direction(random);
    RotationPoints points;
    for (int i = 0; i < 12; ++i)
    {
        const double angle = std::uniform_real_distribution<double>(-swing, swing)(random);
        Quaternion q = multiply(center, turn(one_axis ? axis : direction(random), angle));
        if (random() % 2 == 0)
            q = scaled(q, -1);
        points.points.push_back(q);
    }
    return points;
}

AnimationChannelRecord makeChannel(Interpolation kind, uint32_t components, uint32_t keys)
{
    AnimationChannelRecord channel{};
    channel.interpolation = static_cast<uint32_t>(kind);
    channel.components = components;
    channel.key_count = keys;
    channel.first_value = keys;
    return channel;
}

} // namespace

TEST(RotationSet, holdsAllBlendsOfItsPoints)
{
    std::mt19937 random(1);
    for (int i = 0; i < 60; ++i)
    {
        // up to more than half a turn between two points: then the hull is any rotation
        const double swing = 0.02 * std::pow(1.1, i);
        const RotationPoints points = pointsAround(random, swing, i % 2 == 0);
        const RotationSet set = RotationSet::around(points);
        for (const double tolerance : {0.003, 0.05, 0.3, 3.0})
        {
            if (set.hullSize(tolerance) > 20000)
                continue;
            const RotationHull hull = set.hull(tolerance);
            EXPECT_LE(hull.matrices.size(), set.hullSize(tolerance));
            for (int k = 0; k < 40; ++k)
                ASSERT_LE(measureOutside(hull, anyBlend(points, random), random), kRounding)
                    << "swing " << swing << ", tolerance " << tolerance;
        }
    }
}

TEST(RotationSet, isTightAtItsTolerance)
{
    // rotations about z from 0 to 60 degrees: x goes to cos 60 .. 1, and nothing leaves the plane
    const Double3 z{0, 0, 1};
    const RotationSet set = RotationSet::around({{turn(z, 0), turn(z, std::numbers::pi / 3)}, false});
    const RotationHull hull = set.hull(0.01);
    EXPECT_LE(hull.matrices.size(), 30u);
    for (const Matrix3& m : hull.matrices)
    {
        EXPECT_GE(m[0][0] + hull.slack, 0.5 - 0.02);
        EXPECT_LE(m[0][0] - hull.slack, 1.0 + 0.02);
        EXPECT_NEAR(m[2][0], 0, 1e-6);
    }
}

TEST(RotationSet, aFinerHullIsNeverSaidToBeSmaller)
{
    // a joint whose bind matrix is nearly singular needs arbitrarily small tolerances
    std::mt19937 random(2);
    const RotationSet set = RotationSet::around(pointsAround(random, 0.5, false));
    double coarser = 0;
    for (double tolerance = 1; tolerance > 0; tolerance *= 0.25)
    {
        const double size = set.hullSize(tolerance);
        ASSERT_GE(size, coarser) << "tolerance " << tolerance;
        coarser = size;
    }
    EXPECT_GT(coarser, 1e300);
}

TEST(RotationSet, turnsAboutOneAxisKeepIt)
{
    const Double3 axis{0, 0.6, 0.8};
    RotationPoints points;
    for (int i = 0; i < 8; ++i)
        points.points.push_back(turn(axis, i * 0.785));
    const RotationSet set = RotationSet::around(points);
    EXPECT_FALSE(set.unbounded());
    std::mt19937 random(3);
    const RotationHull hull = set.hull(0.02);
    for (int i = 0; i < 500; ++i)
        ASSERT_LE(measureOutside(hull, anyBlend(points, random), random), kRounding);
    for (const Matrix3& m : hull.matrices)
        for (size_t row = 0; row < 3; ++row)
        {
            const double axis_row[3] = {axis.x, axis.y, axis.z};
            EXPECT_NEAR(m[row][0] * axis.x + m[row][1] * axis.y + m[row][2] * axis.z, axis_row[row],
                        1e-3 + hull.slack);
        }
}

TEST(RotationSet, splineThroughNothingCanBeAnyRotation)
{
    RotationPoints points;
    // no tangents, and the end is opposite to the start: the spline passes through 0
    const std::vector<float> keys{0,      1, /**/ 0, 0, 0, 0, 0, 0,  0, 1, 0, 0, 0, 0,
                                  /**/ 0, 0, 0,      0, 0, 0, 0, -1, 0, 0, 0, 0};
    AnimationChannelRecord channel = makeChannel(Interpolation::cubic_spline, 4, 2);
    AnimationTables tables;
    tables.keys = keys;
    addRotations(tables, channel, points);
    EXPECT_TRUE(points.unbounded);
    EXPECT_TRUE(RotationSet::around(points).unbounded());
}

TEST(AddValues, splinesOvershootIsInside)
{
    // from 0 to 0 with tangents of 4 and -4 for one second: 1 in the middle
    const std::vector<float> keys{0, 1, /**/ 0, 0, 4, /**/ -4, 0, 0};
    AnimationChannelRecord channel = makeChannel(Interpolation::cubic_spline, 1, 2);
    Interval range;
    AnimationTables tables;
    tables.keys = keys;
    addValues(tables, channel, 0, range);
    EXPECT_GE(range.high, 1.0);
    EXPECT_LE(range.high, 1.02);
    EXPECT_LE(range.low, 0.0);
    EXPECT_GE(range.low, -0.02);
}

TEST(MorphWeightRanges, joinUnitRangeRestAndClips)
{
    test::Character character = test::randomCharacter({.clips = 2, .splines = true, .morph_targets = 3}, 5);
    const AnimationTables tables = character.tables();
    const std::vector<Interval> ranges = morphWeightRanges(tables, character.mesh.node, 3);
    test::PoseSource poses(tables, 1);
    for (const Interval& range : ranges)
        EXPECT_TRUE(range.contains(0) && range.contains(1));
    for (int i = 0; i < 3000; ++i)
    {
        const ScenePose& pose = poses.next();
        for (size_t target = 0; target < 3; ++target)
            ASSERT_TRUE(ranges[target].contains(pose.morph_weights[target])) << pose.morph_weights[target];
    }
}

namespace
{

/// Compare the relative motion of all pairs of a character's joints with poses.
void checkPairs(const test::CharacterSpec& spec, uint32_t seed)
{
    const test::Character character = test::randomCharacter(spec, seed);
    const AnimationTables tables = character.tables();
    const std::vector<NodeMotion> nodes = nodeMotions(tables);
    Box3d box;
    for (Interval& axis : box)
        axis = {-0.3, 0.3};
    const std::vector<Box3d> reach(spec.joints, box);
    const SkinMotion skin(tables, nodes, 0, reach);
    test::PoseSource poses(tables, seed);
    std::mt19937 random(seed);
    for (int p = 0; p < 60; ++p)
    {
        p == 0 ? poses.rest() : poses.next();
        const std::vector<Affine3d> palette = poses.palette(0, 0);
        for (uint32_t main = 0; main < spec.joints; main += 3)
        {
            const std::optional<Affine3d> inverse = inverted(palette[main]);
            for (uint32_t joint = 0; joint < spec.joints; ++joint)
            {
                const JointMotion* motion = skin.relative(main, joint);
                if (motion == nullptr || !inverse)
                    continue;
                const Affine3d seen = *inverse * palette[joint];
                const Double3 x = direction(random) * 0.3;
                const Double3 place = transformPoint(seen, x);
                const double margin = 1e-6 * (1 + length(place));
                Box3d places{Interval{0, 0}, Interval{0, 0}, Interval{0, 0}};
                motion->addPositionBox(x, {}, 1, places);
                ASSERT_TRUE(places[0].low <= place.x + margin && places[0].high >= place.x - margin &&
                            places[1].low <= place.y + margin && places[1].high >= place.y - margin &&
                            places[2].low <= place.z + margin && places[2].high >= place.z - margin)
                    << main << " " << joint;
                const MatrixBall& ball = motion->ball();
                ASSERT_LE(length(place - transformPoint(ball.center, x)), ball.slackAt(x) + margin);
                const IdentityDeviation departure = *skin.departure(main, joint);
                ASSERT_LE(length(place - x),
                          departure.rotation * length(x - departure.pivot) + departure.shift + margin);
            }
        }
    }
}

} // namespace

TEST(SkinMotion, holdsWhatJointsDo)
{
    for (uint32_t seed = 1; seed <= 6; ++seed)
        checkPairs({}, seed);
}

TEST(SkinMotion, holdsWhatFastSpinsDo)
{
    for (uint32_t seed = 1; seed <= 6; ++seed)
        checkPairs({.spins = true, .opposite = true}, seed);
}

TEST(SkinMotion, holdsWhatSplinesAndScalesDo)
{
    for (uint32_t seed = 1; seed <= 6; ++seed)
        checkPairs({.splines = true, .scale_low = 0.7, .scale_high = 1.4}, seed);
}

TEST(SkinMotion, holdsWhatMirrorsAndMatricesDo)
{
    for (uint32_t seed = 1; seed <= 6; ++seed)
        checkPairs(
            {.scale_low = 0.5, .scale_high = 2, .mirrored = true, .matrices = true, .several_roots = true},
            seed);
}

TEST(SkinMotion, aJointThatStandsStillIsAPoint)
{
    const test::Character character = test::randomCharacter({.clips = 0}, 2);
    const std::vector<NodeMotion> nodes = nodeMotions(character.tables());
    const SkinMotion skin(character.tables(), nodes, 0, std::vector<Box3d>(12));
    const IdentityDeviation departure = *skin.departure(3, 7);
    EXPECT_LT(departure.rotation, 1e-5);
    EXPECT_LT(departure.shift, 0.05) << "bind poses are off by 0.02 each";
}

TEST(SkinMotion, nothingIsSeenFromAJointThatCanBeFlat)
{
    // joint 1 is a child of joint 0 and has scale 0
    test::Character character = test::randomCharacter({.joints = 2, .clips = 0}, 2);
    character.nodes[1].parent = 0;
    character.nodes[1].scale = {0, 0, 0};
    const std::vector<NodeMotion> nodes = nodeMotions(character.tables());
    const SkinMotion skin(character.tables(), nodes, 0, std::vector<Box3d>(2));
    EXPECT_EQ(skin.relative(1, 0), nullptr);
    EXPECT_NE(skin.relative(0, 1), nullptr);
    EXPECT_TRUE(skin.canMirror(1));
}

} // namespace hearth::animation_bounds
