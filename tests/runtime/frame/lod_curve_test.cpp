// Tests the distance curve of the level of detail: its values, rejected curves, and that every cut stays
// valid.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/lod_curve.h"

#include "formats/gpu_shared/decisions.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using namespace shared;

double linearBetween(std::span<const LodKnot> curve, double distance)
{
    if (distance <= double{curve.front().distance})
        return double{curve.front().factor};
    for (size_t i = 1; i < curve.size(); ++i)
        if (distance < double{curve[i].distance})
        {
            const double along = (distance - double{curve[i - 1].distance}) /
                                 (double{curve[i].distance} - double{curve[i - 1].distance});
            return double{curve[i - 1].factor} * (1 - along) + double{curve[i].factor} * along;
        }
    return double{curve.back().factor};
}

FrameView viewWith(const Camera& camera, std::span<const LodKnot> curve)
{
    FrameView view = makeFrameView(camera, 640, 480, 2, 1);
    EXPECT_TRUE(setLodCurve(view, curve).ok());
    return view;
}

struct Inversions
{
    size_t refined = 0, coarse = 0, wrong = 0;
};

/// Count the edges of the hierarchy whose finer group is refined while the coarser one is not.
void countInversions(const formats::PackView& pack, const FrameView& view, Inversions& sum)
{
    for (const formats::InstanceRecord& record : pack.instances())
    {
        Instance instance;
        std::memcpy(static_cast<void*>(&instance), &record, sizeof(instance));
        const auto exceeds = [&](uint32_t group)
        {
            const formats::GroupRecord& g = pack.groups()[group];
            return errorExceeds(view, instance, g.sphere_center, g.sphere_radius, g.error);
        };
        for (const formats::ClusterRecord& cluster : pack.clusters())
        {
            if (cluster.refined_group == kNoGroup)
                continue;
            const bool finer = exceeds(cluster.refined_group);
            ++(finer ? sum.refined : sum.coarse);
            sum.wrong += finer && !exceeds(cluster.group) ? 1u : 0u;
        }
    }
}

/// Rocks about the origin.
formats::PackView buildRocks(TestScene& test)
{
    std::mt19937 random(4);
    const uint32_t mesh =
        test.addMesh(withMaterial(shapes::rock(24, 0.3f), test.addMaterial(plainMaterial())));
    for (int i = 0; i < 4; ++i)
        test.addInstance(mesh, randomAffine(random, 4));
    return test.build();
}

/// Test rocks from random views, with a curve that `set` gives each view.
template <typename Set>
Inversions inversionsWith(Set set)
{
    TestScene test;
    const formats::PackView pack = buildRocks(test);
    std::mt19937 random(9);
    Inversions sum;
    for (int i = 0; i < 400; ++i)
    {
        FrameView view = viewWith(randomCamera(random, 12), {});
        set(view);
        countInversions(pack, view, sum);
    }
    return sum;
}

} // namespace

TEST(LodCurve, isLinearBetweenItsKnots)
{
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i)
    {
        const auto curve = randomLodCurve(random);
        const FrameView view = viewWith({}, curve);
        for (int k = 0; k < 40; ++k)
        {
            const float distance = k == 0 ? curve.back().distance : uniform(random, 0, 60);
            const double expected = linearBetween(curve, double{distance});
            ASSERT_NEAR(double{lodFactor(view, distance)}, expected, expected * 4e-6);
        }
    }
    const FrameView plain = viewWith({}, {});
    EXPECT_EQ(lodFactor(plain, 0), 1);
    EXPECT_EQ(lodFactor(plain, 1e30f), 1);
}

TEST(LodCurve, faultsAreNamed)
{
    const auto expectFault = [](std::vector<LodKnot> curve, const std::string& words)
    {
        FrameView view{};
        const Status status = setLodCurve(view, curve);
        ASSERT_FALSE(status.ok()) << words;
        EXPECT_NE(status.error().detail.find(words), std::string::npos) << status.error().detail;
    };
    expectFault({{-1, 1}}, "knot 1");
    expectFault({{0, 0}}, "factor above 0");
    expectFault({{0, 1}, {NAN, 1}}, "knot 2");
    expectFault({{5, 1}, {5, 1}}, "no farther away");
    expectFault({{1, 1}, {2, 2.1f}}, "grows faster than the distance");
    expectFault({{0, 1}, {10, 9}}, "8 times");
    expectFault({{0, 1}, {10, 0.1f}}, "8 times");
    expectFault(std::vector<LodKnot>(9), "9 knots");
    FrameView view{};
    EXPECT_TRUE(setLodCurve(view, std::vector<LodKnot>{{1, 1}, {2, 2}, {4, 4}}).ok());
}

TEST(LodCurve, noGroupIsRefinedBelowOneThatIsNot)
{
    std::mt19937 curves(8);
    const Inversions sum =
        inversionsWith([&](FrameView& view) { EXPECT_TRUE(setLodCurve(view, randomLodCurve(curves)).ok()); });
    EXPECT_EQ(sum.wrong, 0u);
    EXPECT_GT(sum.refined, 1000u);
    EXPECT_GT(sum.coarse, 1000u);
}

TEST(LodCurve, oneThatGrowsTooFastWouldTearTheCut)
{
    const Inversions sum = inversionsWith(
        [](FrameView& view) {
            view.lod_curve[0] = {5, 1e-3f, 1e3f, 1.0f / 5};
        });
    EXPECT_GT(sum.wrong, 0u);
}

} // namespace hearth::test
