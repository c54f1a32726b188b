// Tests the fit of all levels to the samples of the finest level, and that levels match where mixed cuts join
// them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/closest_point.h"
#include "cook/visibility/fit/level_fit.h"
#include "tests/cook/visibility/mesh_samples.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"

#include <array>
#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <tbb/global_control.h>

namespace hearth::visibility
{

using test::getPoint;
using test::makeMeshView;
using test::makeSamples;

namespace
{

/// Visibility of a sphere with dips that are some triangles of the finest level wide.
Moments fieldAt(Float3 p, float frequency)
{
    const Float3 n = normalizeOr(p, {0, 0, 1});
    const float dips =
        std::sin(frequency * n.x) * std::sin(frequency * n.y + 1) * std::sin(frequency * n.z + 2);
    return {4.5f + 0.5f * n.y + 0.6f * dips, n * (2.2f + 0.3f * n.z + 0.3f * dips)};
}

/// Three levels of one sphere, samples on the finest, and their values.
struct Levels
{
    std::vector<mesh::SourceMesh> meshes;
    std::vector<std::vector<uint32_t>> finer_vertex;
    std::vector<SurfaceSample> samples;
    std::vector<Moments> values;
    std::vector<LevelMesh> views;
};

/// Return the vertices in a band that a level shares with the next finer one. Bands stand for locked borders.
std::vector<uint32_t> lockedIn(const mesh::SourceMesh& level, const mesh::SourceMesh& finer)
{
    std::map<std::array<float, 3>, uint32_t> of_position;
    for (uint32_t v = 0; v < finer.vertexCount(); ++v)
        of_position.insert({{finer.positions[v].x, finer.positions[v].y, finer.positions[v].z}, v});
    std::vector<uint32_t> result(level.vertexCount(), kInvalidIndex);
    for (uint32_t v = 0; v < level.vertexCount(); ++v)
        if (const Float3 p = level.positions[v]; std::abs(p.y) < 0.15f)
            if (const auto found = of_position.find({p.x, p.y, p.z}); found != of_position.end())
                result[v] = found->second;
    return result;
}

Levels makeLevels(float frequency = 7)
{
    Levels levels;
    for (const uint32_t n : test::kSanitized ? std::array{20u, 10u, 5u} : std::array{32u, 16u, 8u})
        levels.meshes.push_back(shapes::rock(n, 0));
    levels.samples = makeSamples(makeMeshView(levels.meshes[0]), 4);
    for (const SurfaceSample& sample : levels.samples)
        levels.values.push_back(fieldAt(getPoint(makeMeshView(levels.meshes[0]), sample), frequency));
    for (size_t i = 0; i < levels.meshes.size(); ++i)
    {
        levels.finer_vertex.push_back(i == 0 ? std::vector<uint32_t>{}
                                             : lockedIn(levels.meshes[i], levels.meshes[i - 1]));
        levels.views.push_back({makeMeshView(levels.meshes[i]), levels.finer_vertex[i], 0});
    }
    return levels;
}

/// Return the RMS error of values interpolated over a level, against the field over the whole surface of the
/// finest level.
double rmsError(const MeshView& level, const std::vector<Moments>& moments, const MeshView& finest,
                float frequency)
{
    const mesh::ClosestPoint surface(level, level.triangleCount());
    double sum = 0, area = 0;
    for (const SurfaceSample& sample : makeSamples(finest, 3, 77))
    {
        const Float3 p = getPoint(finest, sample);
        const mesh::ClosestPoint::Hit found = surface.find(p, p, 100, kInvalidIndex);
        const uint32_t* corners = &level.indices[size_t{found.triangle} * 3];
        const float weights[3] = {1 - found.u - found.v, found.u, found.v};
        float m0 = 0;
        for (size_t k = 0; k < 3; ++k)
            m0 += moments[corners[k]].m0 * weights[k];
        const double off = m0 - fieldAt(p, frequency).m0;
        sum += off * off * sample.area;
        area += sample.area;
    }
    return std::sqrt(sum / area);
}

/// Return a level's moments if each vertex copies the nearest vertex of the finest level.
std::vector<Moments> copied(const MeshView& level, const MeshView& finest,
                            const std::vector<Moments>& moments)
{
    std::vector<Moments> result;
    for (const Float3 p : level.positions)
    {
        uint32_t nearest = 0;
        for (uint32_t v = 1; v < finest.positions.size(); ++v)
            if (length(finest.positions[v] - p) < length(finest.positions[nearest] - p))
                nearest = v;
        result.push_back(moments[nearest]);
    }
    return result;
}

} // namespace

TEST(FitLevels, areNearerToTheTruthThanCopies)
{
    for (const float frequency : {7.0f, 14.0f})
        for (const float noise : {0.0f, 0.12f}) // noise of 64 rays
        {
            if (test::kSanitized && (frequency > 10 || noise == 0))
                continue;
            Levels levels = makeLevels(frequency);
            std::mt19937 random(1);
            for (Moments& m : levels.values)
            {
                float sum = 0;
                for (int i = 0; i < 4; ++i)
                    sum += static_cast<float>(random() >> 8) * 0x1p-24f - 0.5f;
                m.m0 += noise * sum * std::sqrt(3.0f);
            }
            for (LevelMesh& view : levels.views)
                view.finer_vertex = {};
            const std::vector<LevelFit> fits = fitLevels(levels.views, levels.samples, levels.values);
            ASSERT_EQ(fits.size(), 3u);
            const MeshView finest = levels.views[0].mesh;
            EXPECT_LT(rmsError(finest, fits[0].moments, finest, frequency), 0.04);
            for (size_t i = 1; i < 3; ++i)
            {
                const MeshView level = levels.views[i].mesh;
                const double fitted = rmsError(level, fits[i].moments, finest, frequency);
                const double copy =
                    rmsError(level, copied(level, finest, fits[0].moments), finest, frequency);
                std::printf(
                    "waves %.0f, noise %.2f, level %zu: rms of m0 %.4f fitted, %.4f copied; %u iterations\n",
                    frequency, noise, i, fitted, copy, fits[i].statistics.solve.iterations);
                EXPECT_LT(fitted, 0.96 * copy);
                EXPECT_EQ(fits[i].statistics.lost_samples, 0u);
                EXPECT_LE(fits[i].samples, levels.views[i - 1].mesh.triangleCount());
            }
        }
}

TEST(FitLevels, holdWhatTheLevelBelowHas)
{
    const Levels levels = makeLevels();
    const std::vector<LevelFit> fits = fitLevels(levels.views, levels.samples, levels.values);
    for (size_t i = 1; i < fits.size(); ++i)
    {
        size_t held = 0;
        for (size_t v = 0; v < fits[i].moments.size(); ++v)
            if (const uint32_t finer = levels.finer_vertex[i][v]; finer != kInvalidIndex)
            {
                ++held;
                EXPECT_EQ(std::memcmp(&fits[i].moments[v], &fits[i - 1].moments[finer], sizeof(Moments)), 0);
            }
        EXPECT_GT(held, 10u);
        EXPECT_GT(fits[i].statistics.held, 10u);
        EXPECT_LT(fits[i].statistics.held, fits[i].statistics.vertices / 2);
        const MeshView level = levels.views[i].mesh, finest = levels.views[0].mesh;
        EXPECT_LT(rmsError(level, fits[i].moments, finest, 7),
                  rmsError(level, copied(level, finest, fits[0].moments), finest, 7));
    }
}

TEST(FitLevels, giveCoincidentVerticesOneValue)
{
    const Levels levels = makeLevels();
    const std::vector<LevelFit> fits = fitLevels(levels.views, levels.samples, levels.values);
    for (size_t i = 0; i < fits.size(); ++i)
    {
        std::map<std::array<float, 3>, Moments> of_position;
        size_t seams = 0;
        for (size_t v = 0; v < fits[i].moments.size(); ++v)
        {
            const Float3 p = levels.meshes[i].positions[v];
            const auto [at, is_new] = of_position.insert({{p.x, p.y, p.z}, fits[i].moments[v]});
            seams += !is_new;
            EXPECT_EQ(std::memcmp(&at->second, &fits[i].moments[v], sizeof(Moments)), 0);
        }
        EXPECT_GT(seams, 50u);
    }
}

TEST(FitLevels, haveTheSameBitsForAnyNumberOfThreads)
{
    const Levels levels = makeLevels();
    std::vector<std::vector<LevelFit>> results;
    for (const size_t threads : {1u, 3u})
    {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        results.push_back(fitLevels(levels.views, levels.samples, levels.values));
    }
    for (size_t i = 0; i < 3; ++i)
        EXPECT_EQ(std::memcmp(results[0][i].moments.data(), results[1][i].moments.data(),
                              results[0][i].moments.size() * sizeof(Moments)),
                  0);
}

TEST(FitLevels, doNotTakeSamplesOfTheOtherSide)
{
    // a sheet thinner than its triangles are long, whose two sides have different visibility
    mesh::SourceMesh fine = shapes::grid(16), coarse = shapes::grid(4);
    Levels levels;
    for (mesh::SourceMesh* side : {&fine, &coarse})
    {
        const Float3 n =
            normalizeOr(cross(side->positions[side->indices[1]] - side->positions[side->indices[0]],
                              side->positions[side->indices[2]] - side->positions[side->indices[0]]),
                        {});
        side->normals.assign(side->vertexCount(), n);
        mesh::SourceMesh back = *side;
        for (size_t v = 0; v < back.vertexCount(); ++v)
        {
            back.positions[v] += n * (side == &fine ? -0.01f : -0.002f);
            back.normals[v] = -n;
        }
        for (size_t t = 0; t < back.indices.size(); t += 3)
            std::swap(back.indices[t], back.indices[t + 1]);
        shapes::append(*side, back);
    }
    const std::array<LevelMesh, 2> views{LevelMesh{makeMeshView(fine), {}, 0},
                                         LevelMesh{makeMeshView(coarse), {}, 0.05f}};
    const std::vector<SurfaceSample> samples = makeSamples(views[0].mesh, 4);
    std::vector<Moments> values;
    for (const SurfaceSample& sample : samples)
        values.push_back({sample.triangle < fine.triangleCount() / 2 ? 1.0f : 5.0f, {}});
    const std::vector<LevelFit> fits = fitLevels(views, samples, values);
    for (size_t v = 0; v < coarse.vertexCount(); ++v)
        EXPECT_NEAR(fits[1].moments[v].m0, v < coarse.vertexCount() / 2 ? 1 : 5, 1e-5f);
    EXPECT_EQ(fits[1].statistics.lost_samples, 0u);

    std::array<LevelMesh, 2> near = views;
    near[1].reach = 0.001f;
    const LevelFit nearer = fitLevels(near, samples, values)[1];
    EXPECT_NEAR(nearer.statistics.lost_samples, nearer.samples / 2, 2);
}

TEST(AverageByTriangle, keepsTheIntegralsOfLinearFunctions)
{
    const std::vector<SurfaceSample> samples{{2, 0.1f, 0.2f, 1, 1},
                                             {kInvalidIndex, 0, 0, 9, 1},
                                             {2, 0.7f, 0.1f, 3, 1},
                                             {0, 0.2f, 0.5f, 2, 1},
                                             {2, 0.2f, 0.6f, 2, 0.5f}};
    std::vector<Moments> values;
    for (const SurfaceSample& sample : samples)
        values.push_back({1 + 2 * sample.u - sample.v, {sample.u, sample.v, 3}});
    const SampledValues means = averageByTriangle(samples, values, 4);
    ASSERT_EQ(means.samples.size(), 2u);
    EXPECT_EQ(means.samples[0], samples[3]);
    EXPECT_EQ(means.samples[1].triangle, 2u);
    EXPECT_FLOAT_EQ(means.samples[1].area, 6);
    EXPECT_FLOAT_EQ(means.samples[1].weight, 5.0f / 6);
    // by area and weight: 1, 3 and 1 of 5
    EXPECT_FLOAT_EQ(means.samples[1].u, (0.1f + 3 * 0.7f + 0.2f) / 5);
    for (size_t i = 0; i < 2; ++i)
    {
        const SurfaceSample& at = means.samples[i];
        EXPECT_NEAR(means.values[i].m0, 1 + 2 * at.u - at.v, 1e-6f);
        EXPECT_NEAR(means.values[i].m1.x, at.u, 1e-6f);
        EXPECT_EQ(means.values[i].m1.z, 3.0f);
    }
}

} // namespace hearth::visibility
