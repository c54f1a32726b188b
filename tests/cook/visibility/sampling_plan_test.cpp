// Tests that rays are distributed within their budget, on levels that have enough of them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/sampling_plan.h"

#include <gtest/gtest.h>
#include <tuple>

namespace hearth::visibility
{

namespace
{

/// Return levels that halve the triangles each time.
std::vector<uint64_t> halved(uint64_t triangles, size_t levels)
{
    std::vector<uint64_t> counts;
    for (size_t level = 0; level < levels; ++level)
        counts.push_back(triangles >> level);
    return counts;
}

double countRays(const MeshSampling& sampling, const std::vector<uint64_t>& triangles)
{
    return sampling.samples_per_vertex * sampling.rays_per_sample *
           static_cast<double>(triangles[sampling.level]) / 2;
}

} // namespace

TEST(PlanSampling, givesAllThatIsAskedForWithinTheBudget)
{
    const std::vector<std::vector<uint64_t>> meshes{halved(1000, 5), {}, halved(40'000, 9)};
    // 41,000 triangles ask for 256 rays each
    for (const SamplingSettings& settings :
         {SamplingSettings{}, SamplingSettings{8, 64, 41'000 * 256.0, 0}, SamplingSettings{8, 64, 1, 256}})
        for (const MeshSampling& sampling : planSampling(meshes, settings))
        {
            EXPECT_EQ(sampling.level, 0u);
            EXPECT_EQ(sampling.samples_per_vertex, 8);
            EXPECT_EQ(sampling.rays_per_sample, 64u);
        }
}

TEST(PlanSampling, givesLargeMeshesTheSquareRootOfTheirSize)
{
    // Both large meshes exceed the threshold t: 256 (100 + sqrt(t) (300 + 2000)) = budget with t = 400.
    const std::vector<std::vector<uint64_t>> meshes{halved(4'000'000, 14), halved(100, 1), halved(90'000, 9)};
    const SamplingSettings settings{8, 64, 256.0 * (100 + 20 * 2300), 0};
    const std::vector<MeshSampling> plan = planSampling(meshes, settings);
    EXPECT_EQ(plan[1].samples_per_vertex, 8);
    EXPECT_EQ(plan[1].rays_per_sample, 64u);
    // Rays of the large meshes: 256 * 20 * 2000 and 256 * 20 * 300, about 32 of them a triangle.
    EXPECT_EQ(plan[0].level, 4u);
    EXPECT_EQ(plan[2].level, 1u);
    EXPECT_NEAR(countRays(plan[0], meshes[0]), 256.0 * 20 * 2000, 1);
    EXPECT_NEAR(countRays(plan[2], meshes[2]), 256.0 * 20 * 300, 1);
    for (const size_t mesh : {0u, 2u})
    {
        EXPECT_EQ(plan[mesh].rays_per_sample, 32u);
        EXPECT_GE(plan[mesh].samples_per_vertex, 2);
        EXPECT_LT(plan[mesh].samples_per_vertex, 4.1) << "a finer level would have had enough";
    }
}

TEST(PlanSampling, givesAMeshAndItsCopiesWhatOneMeshOfAllTheirTrianglesGets)
{
    const std::vector<std::vector<uint64_t>> copied{
        halved(100'000, 9), halved(500'000, 9), halved(100'000, 9), halved(100'000, 9), halved(100'000, 9)};
    const std::vector<std::vector<uint64_t>> joined{halved(400'000, 9), halved(500'000, 9)};
    const std::vector<uint32_t> originals{0, 1, 0, 0, 0};
    const SamplingSettings settings{8, 64, 0x1p23, 0};
    const std::vector<MeshSampling> plan = planSampling(copied, settings, originals);
    const std::vector<MeshSampling> expected = planSampling(joined, settings);
    EXPECT_EQ(countRays(plan[1], copied[1]), countRays(expected[1], joined[1]));
    for (const size_t mesh : {0u, 2u, 3u, 4u})
        EXPECT_NEAR(countRays(plan[mesh], copied[mesh]), countRays(expected[0], joined[0]) / 4, 1) << mesh;
}

TEST(PlanSampling, givesLargeMeshesMoreByTheirWeight)
{
    const std::vector<std::vector<uint64_t>> meshes{halved(400'000, 9), halved(100, 1), halved(400'000, 9)};
    const std::vector<double> weights{0.5, 1, 1.5};
    const SamplingSettings settings{8, 64, 0x1p23, 0};
    const std::vector<MeshSampling> plan = planSampling(meshes, settings, {}, weights);
    EXPECT_EQ(plan[1].samples_per_vertex, 8) << "small meshes get all";
    EXPECT_EQ(plan[1].rays_per_sample, 64u);
    // two samples a vertex are the least
    EXPECT_NEAR(countRays(plan[2], meshes[2]) / countRays(plan[0], meshes[0]), 3, 0.1);
    EXPECT_NEAR((countRays(plan[0], meshes[0]) + countRays(plan[2], meshes[2])) / 0x1p23, 1, 0.05);
}

TEST(PlanSampling, givesWholeMeshesNoMoreThanTheyAskFor)
{
    const std::vector<std::vector<uint64_t>> meshes{halved(20'000, 7), halved(400'000, 9)};
    const std::vector<double> weights{4, 0.5};
    const std::vector<MeshSampling> plan = planSampling(meshes, {8, 64, 0x1p23, 0}, {}, weights);
    EXPECT_EQ(countRays(plan[0], meshes[0]), 20'000 * 256);
    EXPECT_NEAR(countRays(plan[1], meshes[1]), 0x1p23 - 20'000 * 256, 1);
}

TEST(PlanSampling, takesFewerSamplesBeforeFewerRays)
{
    const std::vector<std::vector<uint64_t>> meshes{halved(1'000'000, 9)};
    for (const auto& [share, samples, rays] : {std::tuple(0.9, 7.2, 64u), std::tuple(0.5, 4.0, 64u),
                                               std::tuple(0.4, 6.4, 32u), std::tuple(0.2, 3.2, 32u)})
    {
        const MeshSampling sampling = planSampling(meshes, {8, 64, share * 256e6, 0})[0];
        EXPECT_EQ(sampling.level, 0u);
        EXPECT_NEAR(sampling.samples_per_vertex, samples, 1e-6);
        EXPECT_EQ(sampling.rays_per_sample, rays);
    }
}

TEST(PlanSampling, takesAtLeastTwoSamplesWhereNoCoarserLevelIs)
{
    const std::vector<std::vector<uint64_t>> meshes{halved(1'000'000, 2)};
    const MeshSampling sampling = planSampling(meshes, {8, 64, 1000, 0})[0];
    EXPECT_EQ(sampling.level, 1u);
    EXPECT_EQ(sampling.samples_per_vertex, 2);
    // each triangle takes one, whatever is asked for
    const MeshSampling draft = planSampling(meshes, {1, 16, 1000, 0})[0];
    EXPECT_EQ(draft.samples_per_vertex, 2);
    EXPECT_EQ(draft.rays_per_sample, 16u);
    EXPECT_EQ(planSampling(meshes, {1, 16, 16e6, 0})[0].level, 0u);
    EXPECT_EQ(planSampling(meshes, {1, 16, 11e6, 0})[0].level, 1u);
}

} // namespace hearth::visibility
