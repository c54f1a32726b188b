// Tests the visibility of instances: the moments of a visibility times a linear function against sums over
// directions, the fit of that function, and a stone in a cave beside one on a hill.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/visibility_factor.h"
#include "cook/visibility/program/instance_visibility.h"
#include "cook/visibility/rays/sampled_moments.h"
#include "formats/base/half.h"
#include "tests/cook/visibility/ray_scenes.h"

#include <gtest/gtest.h>

#include <functional>

namespace hearth::visibility
{
namespace
{

using shared::VisibilityMoments;

/// Sum a visibility over directions of equal solid angles.
Moments integrate(const std::function<double(Float3)>& visibility)
{
    constexpr int kHeights = 200, kTurns = 400;
    double m0 = 0, x = 0, y = 0, z = 0;
    for (int i = 0; i < kHeights; ++i)
        for (int j = 0; j < kTurns; ++j)
        {
            const double height = 1 - (2 * i + 1.0) / kHeights, turn = 2 * kPi * (j + 0.5) / kTurns;
            const double across = std::sqrt(1 - height * height);
            const Float3 d{static_cast<float>(across * std::cos(turn)),
                           static_cast<float>(across * std::sin(turn)), static_cast<float>(height)};
            const double v = visibility(d) * 4 * kPi / (kHeights * kTurns);
            m0 += v;
            x += v * double{d.x};
            y += v * double{d.y};
            z += v * double{d.z};
        }
    return {static_cast<float>(m0), {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}};
}

double factorAt(Float4 factor, Float3 d)
{
    return double{factor.x * d.x + factor.y * d.y + factor.z * d.z + factor.w};
}

TEST(ChangedVisibility, ofConesHasTheMomentsOfTheProduct)
{
    const Float4 factor{0.2f, -0.3f, 0.1f, 0.6f};
    for (const float cosine : {0.0f, 0.3f, 0.7f, 0.95f})
    {
        // a cone about +z, half of whose light arrives
        const Float3 axis = kUp;
        const auto cone = [&](Float3 d) { return dot(d, axis) > cosine ? 0.5 : 0.0; };
        const float pi = static_cast<float>(kPi);
        const VisibilityMoments moments{pi * (1 - cosine), axis * (0.5f * pi * (1 - cosine * cosine))};
        const VisibilityMoments changed = shared::changedVisibility(moments, kUp, factor);
        const Moments expected = integrate([&](Float3 d) { return cone(d) * factorAt(factor, d); });
        EXPECT_NEAR(changed.m0, expected.m0, 0.02);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(changed.m1[c], expected.m1[c], 0.02) << cosine << " " << c;
    }
}

TEST(ChangedVisibility, byOneIsTheSameBits)
{
    const VisibilityMoments moments{1.2345f, {0.3f, -0.21f, 0.77f}};
    const VisibilityMoments changed = shared::changedVisibility(moments, kUp, {0, 0, 0, 1});
    EXPECT_EQ(changed.m0, moments.m0);
    EXPECT_EQ(changed.m1, moments.m1);
}

std::vector<FactorSample> makeOpenSamples(Float4 factor)
{
    std::vector<FactorSample> samples;
    for (const Float3 direction : {Float3{0, 0, 1},
                                   {0, 0, -1},
                                   {1, 0, 0},
                                   {-1, 0, 0},
                                   {0, 1, 0},
                                   {0, -1, 0},
                                   {1, 1, 1},
                                   {-1, 2, 0.5f}})
    {
        const Float3 normal = normalizeOr(direction, {});
        const Moments seen =
            integrate([&](Float3 d) { return dot(d, normal) > 0 ? factorAt(factor, d) : 0; });
        const float pi = static_cast<float>(kPi);
        samples.push_back({normal, {2 * pi, normal * pi}, {seen, seen}});
    }
    return samples;
}

TEST(FitFactor, findsTheFunction)
{
    for (const Float4 factor :
         {Float4{0, 0, 0, 1}, {0, 0, 0, 0.4f}, {0.3f, 0, 0, 0.6f}, {0.1f, -0.2f, 0.25f, 0.5f}})
    {
        const VisibilityFactor found = fitFactor(makeOpenSamples(factor));
        EXPECT_NEAR(found.terms.x, factor.x, 0.01);
        EXPECT_NEAR(found.terms.y, factor.y, 0.01);
        EXPECT_NEAR(found.terms.z, factor.z, 0.01);
        EXPECT_NEAR(found.terms.w, factor.w, 0.01);
        EXPECT_NEAR(found.error_with_factor, 0, 1e-4);
    }
}

TEST(FitFactor, staysAtOneWithoutVisibility)
{
    const FactorSample dark{kUp, {0, {}}, {}};
    const VisibilityFactor found = fitFactor({&dark, 1});
    EXPECT_EQ(found.terms, (Float4{0, 0, 0, 1}));
    EXPECT_EQ(found.error_of_mean, 0);
}

/// A round stone on a hill, and one in a cave that is open to +x.
class StonesTest : public testing::Test
{
protected:
    StonesTest()
    {
        stone_ = makeSphere(16, 32, 1, false);
        Mesh floor = makeFloor(50);
        cave_.addQuad({-3, -2, 0}, {3, -2, 0}, {3, -2, 3}, {-3, -2, 3});
        cave_.addQuad({-3, 2, 0}, {3, 2, 0}, {3, 2, 3}, {-3, 2, 3});
        cave_.addQuad({-3, -2, 0}, {-3, 2, 0}, {-3, 2, 3}, {-3, -2, 3});
        cave_.addQuad({-3, -2, 3}, {3, -2, 3}, {3, 2, 3}, {-3, 2, 3});
        instances_ = {{0, scaledAndMoved(1, {20, 0, 1.1f})}, {1, scaledAndMoved(1, {0.5f, 0, 1.1f})}};
        world_.place(world_.add(floor.occluder()));
        world_.place(world_.add(cave_.occluder()));
        const auto mesh = world_.add(stone_.occluder());
        for (const MeshInstance& instance : instances_)
            world_.place(mesh, instance.world_from_mesh);
        world_.finish();
        samples_ = surfaceSamples(stone_.positions, stone_.corners, {.samples_per_vertex = 4});
        std::vector<Placement> places;
        for (const MeshInstance& instance : instances_)
            places.push_back({&world_, instance.world_from_mesh, {}});
        mean_ =
            *sampledMoments({stone_.positions, {}, stone_.corners}, samples_, places,
                            {.rays_per_sample = 256}, false, [](size_t, uint64_t, uint64_t) { return true; });
    }

    SampledSurface surface() const
    {
        return {stone_.positions, stone_.corners, samples_, mean_.moments, mean_.interior};
    }

    /// Return the rms difference of an instance's ambient occlusion from its own bake, by its factor.
    double error(const MeshInstance& instance, const formats::SurroundingsRecord& record) const
    {
        const std::vector<SamplePoint> points =
            samplePoints(stone_.positions, stone_.corners, samples_, instance.world_from_mesh);
        const auto seen = visibilityMoments(world_, points, {.rays_per_sample = 1024, .seed = 99});
        const auto term = [&](size_t i) { return floatFromHalf(record.visibility[i]); };
        double sum = 0;
        for (size_t s = 0; s < points.size(); ++s)
        {
            const Moments& mean = mean_.moments[s];
            const VisibilityMoments changed = shared::changedVisibility({mean.m0, mean.m1}, points[s].normal,
                                                                        {term(0), term(1), term(2), term(3)});
            sum += std::pow(computeOcclusion(changed, points[s].normal) -
                                double{dot((*seen)[s].m1, points[s].normal)} / kPi,
                            2);
        }
        return std::sqrt(sum / static_cast<double>(points.size()));
    }

    Mesh stone_, cave_;
    Occluders world_;
    std::vector<MeshInstance> instances_;
    std::vector<SurfaceSample> samples_;
    SampledMoments mean_;
};

TEST_F(StonesTest, inACaveAndOnAHillHaveTheirOwnOcclusion)
{
    std::vector<formats::SurroundingsRecord> records(2, formats::kPlainSurroundings);
    const InstanceSpread spread = fitInstances(world_, surface(), instances_, 1e6, {}, records);
    EXPECT_EQ(spread.changed_instances, 2u);
    double squares = 0, squares_of_mean = 0;
    for (const MeshInstance& instance : instances_)
    {
        const double with = error(instance, records[instance.number]),
                     without = error(instance, formats::kPlainSurroundings);
        std::printf("rms of ambient occlusion: %.4f with the factor, %.4f with the mean\n", with, without);
        EXPECT_GT(without, 0.15);
        EXPECT_LT(with, 0.06);
        squares += with * with / 2;
        squares_of_mean += without * without / 2;
    }
    // what the report says, by few rays
    std::printf("spread: %.4f, with factors %.4f\n", spread.of_mean, spread.with_factors);
    EXPECT_NEAR(spread.of_mean, std::sqrt(squares_of_mean), 0.02);
    EXPECT_NEAR(spread.with_factors, std::sqrt(squares), 0.02);
}

TEST_F(StonesTest, staysWithinTheRays)
{
    std::vector<formats::SurroundingsRecord> records(2, formats::kPlainSurroundings);
    EXPECT_LE(fitInstances(world_, surface(), instances_, 1000, {}, records).rays, 1000u);
    EXPECT_LE(fitInstances(world_, surface(), instances_, 300, {}, records).rays, 300u);
}

TEST_F(StonesTest, thatAreAlikeKeepTheMean)
{
    const std::vector<MeshInstance> alike{instances_[0], {1, scaledAndMoved(1, {20, 20, 1.1f})}};
    std::vector<Placement> places;
    for (const MeshInstance& instance : alike)
        places.push_back({&world_, instance.world_from_mesh, {}});
    mean_ = *sampledMoments({stone_.positions, {}, stone_.corners}, samples_, places,
                            {.rays_per_sample = 256}, false, [](size_t, uint64_t, uint64_t) { return true; });
    std::vector<formats::SurroundingsRecord> records(2, formats::kPlainSurroundings);
    const InstanceSpread spread = fitInstances(world_, surface(), alike, 1e6, {}, records);
    EXPECT_EQ(spread.changed_instances, 0u);
    EXPECT_EQ(records[0].visibility[3], kHalfOne);
    EXPECT_LT(spread.of_mean, 0.03);
}

} // namespace
} // namespace hearth::visibility
