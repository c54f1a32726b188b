// Tests the second moments of samples in poses and at instances, and the cones refined with them on all
// levels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/refined_levels.h"
#include "cook/visibility/rays/sampled_moments.h"
#include "formats/gpu_shared/visibility_cone.h"
#include "tests/cook/visibility/mesh_samples.h"
#include "tests/cook/visibility/ray_scenes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace hearth::visibility
{

namespace
{

/// Floor with a wall beside it.
Mesh nook()
{
    Mesh mesh;
    mesh.addQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    mesh.addQuad({0, 0, 0}, {0, 1, 0}, {0, 1, 2}, {0, 0, 2});
    return mesh;
}

constexpr Affine3 kTurn{{{0, -1, 0, 5}, {0, 0, -1, 2}, {1, 0, 0, 1}}};

MeshView makeMeshView(const Mesh& mesh)
{
    return {mesh.positions, {}, mesh.corners};
}

SampledMoments seenIn(const Mesh& mesh, std::span<const SurfaceSample> samples, const Placement& place)
{
    RaySettings rays;
    rays.rays_per_sample = 1024;
    const auto go = [](size_t, uint64_t, uint64_t) { return true; };
    return *sampledMoments(makeMeshView(mesh), samples, {&place, 1}, rays, true, go);
}

void expectNear(const SampledMoments& a, const SampledMoments& b, double tolerance)
{
    for (size_t s = 0; s < a.moments.size(); ++s)
    {
        EXPECT_NEAR(a.moments[s].m0, b.moments[s].m0, tolerance);
        EXPECT_LT(length(a.moments[s].m1 - b.moments[s].m1), tolerance);
        const SecondMoments &m = a.second[s], &n = b.second[s];
        EXPECT_LT(std::abs(m.xx - n.xx) + std::abs(m.yy - n.yy) + std::abs(m.zz - n.zz), tolerance);
        EXPECT_LT(std::abs(m.xy - n.xy) + std::abs(m.xz - n.xz) + std::abs(m.yz - n.yz), tolerance);
    }
}

/// Directions of equal weight over a hemisphere.
std::vector<Double3> hemisphere()
{
    std::vector<Double3> directions;
    constexpr int kRows = 100, kColumns = 200;
    for (int i = 0; i < kRows; ++i)
        for (int j = 0; j < kColumns; ++j)
        {
            const double z = (i + 0.5) / kRows, turn = 2 * kPi * (j + 0.5) / kColumns;
            const double r = std::sqrt(1 - z * z);
            directions.push_back({r * std::cos(turn), r * std::sin(turn), z});
        }
    return directions;
}

/// Visibility through two openings, one wider than the other.
struct TwoOpenings
{
    Moments moments;
    SecondMoments second;
    Sh9 harmonics{};

    TwoOpenings()
    {
        const std::vector<Double3> directions = hemisphere();
        const double share = 2 * kPi / static_cast<double>(directions.size());
        Double3 m1;
        double m0 = 0, products[6] = {0, 0, 0, 0, 0, 0};
        for (const Double3 w : directions)
        {
            const bool open = dot(w, {0.8, 0, 0.6}) > 0.9 || dot(w, {-0.6, 0, 0.8}) > 0.75;
            if (!open)
                continue;
            m0 += share;
            m1 = m1 + w * share;
            const double of_two[6] = {w.x * w.x, w.y * w.y, w.z * w.z, w.x * w.y, w.x * w.z, w.y * w.z};
            for (size_t i = 0; i < 6; ++i)
                products[i] += of_two[i] * share;
            const Sh9 basis = sphericalHarmonics(w);
            for (size_t i = 0; i < 9; ++i)
                harmonics[i] += basis[i] * share;
        }
        const auto f = [](double x) { return static_cast<float>(x); };
        moments = {f(m0), {f(m1.x), f(m1.y), f(m1.z)}};
        second = {f(products[0]), f(products[1]), f(products[2]),
                  f(products[3]), f(products[4]), f(products[5])};
    }
};

} // namespace

TEST(SampledMoments, areThoseOfTheMeshWhereverItIsTurned)
{
    const Mesh mesh = nook(), moved = transformed(mesh, kTurn);
    const auto samples = surfaceSamples(mesh.positions, mesh.corners, {.samples_per_vertex = 4});
    const Occluders itself = makeOccluders({mesh.occluder()}), around = makeOccluders({moved.occluder()});
    const SampledMoments at_rest = seenIn(mesh, samples, {&itself, {}, {}});
    expectNear(at_rest, seenIn(mesh, samples, {&around, kTurn, {}}), 0.06);
    // as in a pose: the visible directions are rotated back with the triangles
    expectNear(at_rest, seenIn(mesh, samples, {&around, {}, moved.positions}), 0.06);
}

TEST(SampledMoments, areMeansOverPlacesOfWhichEachHasItsRays)
{
    const Mesh mesh = nook();
    const auto samples = surfaceSamples(mesh.positions, mesh.corners, {.samples_per_vertex = 2});
    Occluders nothing;
    nothing.finish();
    const Occluders itself = makeOccluders({mesh.occluder()});
    const Placement places[] = {{&itself, {}, {}}, {&nothing, {}, {}}};
    const auto go = [](size_t, uint64_t, uint64_t) { return true; };
    const SampledMoments both = *sampledMoments(makeMeshView(mesh), samples, places, {}, false, go);
    const SampledMoments first = *sampledMoments(makeMeshView(mesh), samples, {places, 1}, {}, false, go);
    EXPECT_EQ(both.rays, 2 * first.rays);
    EXPECT_TRUE(both.second.empty());
    for (size_t s = 0; s < samples.size(); ++s)
        EXPECT_NEAR(both.moments[s].m0, (first.moments[s].m0 + 2 * kPi) / 2, 1e-5);
    size_t calls = 0;
    const auto stop = [&](size_t place, uint64_t, uint64_t) { return ++calls, place == 0; };
    EXPECT_FALSE(sampledMoments(makeMeshView(mesh), samples, places, {}, false, stop));
    EXPECT_GE(calls, 2u);
}

TEST(SampledMoments, sayHowUnlikePlacesAre)
{
    Mesh floor, lid;
    floor.addQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    lid.addQuad({-50, -50, 0.1f}, {-50, 50, 0.1f}, {50, 50, 0.1f}, {50, -50, 0.1f});
    const auto samples = surfaceSamples(floor.positions, floor.corners, {.samples_per_vertex = 500});
    Occluders nothing;
    nothing.finish();
    const Occluders closed = makeOccluders({lid.occluder()}), wall = makeOccluders({nook().occluder()});
    const auto getSpread = [&](std::vector<Placement> places)
    {
        const auto go = [](size_t, uint64_t, uint64_t) { return true; };
        return sampledMoments(makeMeshView(floor), samples, places, {.rays_per_sample = 4}, false, go)
            ->spread;
    };
    const Placement open{&nothing, {}, {}}, shut{&closed, {}, {}}, beside{&wall, {}, {}};
    EXPECT_EQ(getSpread({shut}), 0);
    EXPECT_NEAR(getSpread({open, shut}), 0.5, 1e-3);
    EXPECT_NEAR(getSpread({open, shut, open, shut}), 0.5, 1e-3);
    EXPECT_NEAR(getSpread({open, open, open, shut}), std::sqrt(3.0) / 4, 1e-3);
    // four rays leave noise of .2 where half of the hemisphere is hidden
    EXPECT_LT(getSpread({beside, beside, beside, beside}), 0.03);
}

TEST(RefineLevels, givesEachVertexTheConeNearestToNineHarmonics)
{
    const mesh::SourceMesh fine = shapes::rock(8, 0), coarse = shapes::rock(4, 0);
    const TwoOpenings seen;
    const auto samples = test::makeSamples(test::makeMeshView(fine), 4);
    const std::vector<Moments> values(samples.size(), seen.moments);
    const std::vector<SecondMoments> second(samples.size(), seen.second);
    const LevelMesh levels[] = {{test::makeMeshView(fine), {}, 0}, {test::makeMeshView(coarse), {}, 0}};
    // normals in all directions would clamp the directions below them
    LevelFitSettings settings;
    settings.fit.clamp = false;
    std::vector<LevelFit> fits = fitLevels(levels, samples, values, settings);
    const RefineGain gain = refineLevels(levels, samples, second, settings, fits);
    EXPECT_GT(gain.cones, 0u);
    EXPECT_LT(gain.statistics.rms, 0.97 * gain.statistics.start_rms);
    const auto start = shared::visibilityCone(seen.moments.m0, seen.moments.m1, {});
    for (size_t l = 0; l < 2; ++l)
        for (size_t v = 0; v < fits[l].moments.size(); ++v)
        {
            const RefinedCone wanted =
                refineCone(seen.harmonics, {widen(start.axis), double{start.aperture}, double{start.scale}},
                           widen(levels[l].mesh.normals[v]));
            const Moments m = fits[l].moments[v];
            const auto cone = shared::visibilityCone(m.m0, m.m1, {});
            const Sh9 got = computeHarmonics({widen(cone.axis), double{cone.aperture}, double{cone.scale}});
            double distance2 = 0;
            for (size_t i = 0; i < 9; ++i)
                distance2 += (got[i] - seen.harmonics[i]) * (got[i] - seen.harmonics[i]);
            EXPECT_NEAR(std::sqrt(distance2), std::sqrt(wanted.distance2), 1e-3);
        }
}

TEST(RefineLevels, leavesConesAndOpenHemispheresAlone)
{
    const mesh::SourceMesh fine = shapes::rock(8, 0);
    const auto samples = test::makeSamples(test::makeMeshView(fine), 4);
    const LevelMesh level{test::makeMeshView(fine), {}, 0};
    const Moments open{static_cast<float>(2 * kPi), {0, 0, static_cast<float>(kPi)}};
    const SecondMoments of_open{static_cast<float>(2 * kPi / 3), static_cast<float>(2 * kPi / 3),
                                static_cast<float>(2 * kPi / 3)};
    LevelFitSettings settings;
    settings.fit.clamp = false;
    const std::vector<Moments> values(samples.size(), open);
    const std::vector<SecondMoments> second(samples.size(), of_open);
    std::vector<LevelFit> fits = fitLevels({&level, 1}, samples, values, settings);
    EXPECT_EQ(refineLevels({&level, 1}, samples, second, settings, fits).cones, 0u);
    for (const Moments& m : fits[0].moments)
        EXPECT_NEAR(m.m0, open.m0, 1e-5);
}

TEST(RefineLevels, keepsWhatLevelsHaveInCommonForAnyNumberOfThreads)
{
    const mesh::SourceMesh fine = shapes::rock(8, 0);
    const auto samples = test::makeSamples(test::makeMeshView(fine), 2);
    std::vector<uint32_t> same(fine.vertexCount(), kInvalidIndex);
    for (uint32_t v = 0; v < same.size() / 2; ++v)
        same[v] = v;
    const LevelMesh levels[] = {{test::makeMeshView(fine), {}, 0}, {test::makeMeshView(fine), same, 0}};
    const TwoOpenings seen;
    std::vector<Moments> values;
    std::vector<SecondMoments> second;
    for (const SurfaceSample& sample : samples)
    {
        const float factor = 0.8f + 0.2f * test::getPoint(levels[0].mesh, sample).x;
        values.push_back({seen.moments.m0 * factor, seen.moments.m1 * factor});
        const SecondMoments& m = seen.second;
        second.push_back(
            {m.xx * factor, m.yy * factor, m.zz * factor, m.xy * factor, m.xz * factor, m.yz * factor});
    }
    std::vector<std::vector<LevelFit>> results;
    for (const size_t threads : {1u, 3u})
    {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        results.push_back(fitLevels(levels, samples, values));
        refineLevels(levels, samples, second, {}, results.back());
    }
    for (size_t v = 0; v < same.size() / 2; ++v)
        EXPECT_EQ(results[0][0].moments[v].m1, results[0][1].moments[v].m1);
    for (size_t l = 0; l < 2; ++l)
        for (size_t v = 0; v < same.size(); ++v)
            EXPECT_EQ(results[0][l].moments[v].m1, results[1][l].moments[v].m1);
}

} // namespace hearth::visibility
