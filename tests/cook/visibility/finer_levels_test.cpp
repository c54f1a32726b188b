// Tests the interpolation of levels that are finer than the fitted one.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/finer_levels.h"
#include "tests/cook/visibility/mesh_samples.h"
#include "tests/support/shapes.h"

#include <array>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>
#include <tbb/global_control.h>

namespace hearth::visibility
{

namespace
{

constexpr float kPi = std::numbers::pi_v<float>;

/// Integrate the two moments of what two hemispheres both see.
Moments integrateLune(Float3 a, Float3 b)
{
    constexpr int kRings = 400, kSectors = 800;
    Moments sum;
    for (int ring = 0; ring < kRings; ++ring)
        for (int sector = 0; sector < kSectors; ++sector)
        {
            const float z = (static_cast<float>(ring) + 0.5f) / kRings * 2 - 1, r = std::sqrt(1 - z * z);
            const float turn = (static_cast<float>(sector) + 0.5f) / kSectors * 2 * kPi;
            const Float3 direction{r * std::cos(turn), r * std::sin(turn), z};
            if (dot(direction, a) < 0 || dot(direction, b) < 0)
                continue;
            const float part = 4 * kPi / (kRings * kSectors);
            sum.m0 += part;
            sum.m1 = sum.m1 + direction * part;
        }
    return sum;
}

/// Level of a mesh, with all that its view refers to.
struct Level
{
    mesh::SourceMesh mesh;
    std::vector<uint32_t> finer_vertex;
    std::vector<uint32_t> first_copy;

    LevelMesh view() const { return {test::makeMeshView(mesh), finer_vertex, 0, first_copy}; }
};

Level makeLevel(uint32_t n)
{
    Level level{shapes::rock(n, 0), {}, {}};
    for (uint32_t v = 0; v < level.mesh.vertexCount(); ++v) // the sphere's, on all levels alike
        level.mesh.normals[v] = normalizeOr(level.mesh.positions[v], {});
    for (uint32_t v = 0; v < level.mesh.vertexCount(); ++v)
    {
        uint32_t first = 0;
        while (!(level.mesh.positions[first] == level.mesh.positions[v] &&
                 level.mesh.normals[first] == level.mesh.normals[v]))
            ++first;
        level.first_copy.push_back(first);
    }
    return level;
}

void link(Level& coarse, const Level& fine)
{
    for (uint32_t v = 0; v < coarse.mesh.vertexCount(); ++v)
    {
        uint32_t same = 0;
        while (same < fine.mesh.vertexCount() && !(fine.mesh.positions[same] == coarse.mesh.positions[v] &&
                                                   fine.mesh.normals[same] == coarse.mesh.normals[v]))
            ++same;
        coarse.finer_vertex.push_back(same == fine.mesh.vertexCount() ? kInvalidIndex : same);
    }
}

/// Three levels of a sphere whose fitted one, the last, has values that are linear in space.
struct Sphere
{
    std::vector<Level> levels{makeLevel(32), makeLevel(16), makeLevel(8)};
    std::vector<Moments> fitted;

    Sphere()
    {
        link(levels[1], levels[0]);
        link(levels[2], levels[1]);
        for (uint32_t v = 0; v < levels[2].mesh.vertexCount(); ++v)
            fitted.push_back(valueAt(levels[2].mesh.positions[v], levels[2].mesh.normals[v]));
    }

    static Moments valueAt(Float3 p, Float3 n) { return {3 + p.x, n * (1.5f + 0.5f * p.y)}; }

    std::vector<std::vector<Moments>> interpolate() const
    {
        const std::vector<LevelMesh> views{levels[0].view(), levels[1].view(), levels[2].view()};
        return interpolateFinerLevels(views, fitted);
    }
};

} // namespace

TEST(TiltHemisphere, isTheLuneAboveAnOpenPlane)
{
    const Float3 up{0, 0, 1};
    for (const float angle : {0.0f, 0.3f, 1.0f, 1.5f})
    {
        const Float3 tilted{std::sin(angle), 0, std::cos(angle)};
        const Moments lune = integrateLune(up, tilted);
        const Moments moments = tiltHemisphere({2 * kPi, up * kPi}, up, tilted);
        EXPECT_NEAR(moments.m0, lune.m0, 0.02);
        EXPECT_LT(length(moments.m1 - lune.m1), 0.02f);
        // half as dense
        const Moments half = tiltHemisphere({kPi, up * (kPi / 2)}, up, tilted);
        EXPECT_NEAR(half.m0, lune.m0 / 2, 0.01);
        EXPECT_LT(length(half.m1 - lune.m1 * 0.5f), 0.01f);
    }
}

TEST(InterpolateFinerLevels, isNearTheFittedFunction)
{
    const Sphere sphere;
    const std::vector<std::vector<Moments>> moments = sphere.interpolate();
    ASSERT_EQ(moments.size(), 2u);
    for (size_t l = 0; l < 2; ++l)
        for (uint32_t v = 0; v < sphere.levels[l].mesh.vertexCount(); ++v)
        {
            const Float3 n = sphere.levels[l].mesh.normals[v];
            const Moments expected = Sphere::valueAt(sphere.levels[l].mesh.positions[v], n);
            EXPECT_NEAR(moments[l][v].m0, expected.m0, 0.06f);
            EXPECT_LT(length(moments[l][v].m1 - expected.m1), 0.12f);
        }
}

TEST(InterpolateFinerLevels, keepsTheBitsOfSharedVerticesAndOfCopies)
{
    const Sphere sphere;
    const std::vector<std::vector<Moments>> moments = sphere.interpolate();
    size_t shared = 0, copies = 0;
    for (size_t l = 1; l < 3; ++l)
    {
        const std::vector<Moments>& coarse = l == 2 ? sphere.fitted : moments[l];
        for (size_t v = 0; v < coarse.size(); ++v)
            if (const uint32_t finer = sphere.levels[l].finer_vertex[v]; finer != kInvalidIndex)
            {
                ++shared;
                EXPECT_EQ(std::memcmp(&coarse[v], &moments[l - 1][finer], sizeof(Moments)), 0);
            }
        for (size_t v = 0; v < moments[l - 1].size(); ++v)
        {
            const uint32_t first = sphere.levels[l - 1].first_copy[v];
            copies += first != v;
            EXPECT_EQ(std::memcmp(&moments[l - 1][v], &moments[l - 1][first], sizeof(Moments)), 0);
        }
    }
    EXPECT_GT(shared, 100u);
    EXPECT_GT(copies, 100u);
}

TEST(InterpolateFinerLevels, doesNotCrossHardEdges)
{
    // Two walls that meet at a right angle: each has its own value up to the edge.
    const auto addWall = [](Level& level, uint32_t n, Float3 u, Float3 normal)
    {
        const auto first = static_cast<uint32_t>(level.mesh.positions.size());
        for (uint32_t i = 0; i <= n; ++i)
            for (uint32_t j = 0; j <= n; ++j)
            {
                level.mesh.positions.push_back(u * (static_cast<float>(i) / static_cast<float>(n)) +
                                               Float3{0, 0, static_cast<float>(j) / static_cast<float>(n)});
                level.mesh.normals.push_back(normal);
                level.first_copy.push_back(first + i * (n + 1) + j);
            }
        for (uint32_t i = 0; i < n; ++i)
            for (uint32_t j = 0; j < n; ++j)
            {
                const uint32_t a = first + i * (n + 1) + j, b = a + n + 1;
                std::array<uint32_t, 6> corners{a, b, b + 1, a, b + 1, a + 1};
                const Float3 face = cross(level.mesh.positions[b] - level.mesh.positions[a],
                                          level.mesh.positions[b + 1] - level.mesh.positions[a]);
                if (dot(face, normal) < 0)
                    corners = {a, b + 1, b, a, a + 1, b + 1};
                level.mesh.indices.insert(level.mesh.indices.end(), corners.begin(), corners.end());
            }
    };
    // a vertex on the edge faces both planes; at 40 degrees both triangles face it within 45
    for (const double degrees : {60.0, 40.0})
    {
        const double angle = degrees * std::numbers::pi / 180;
        const auto sine = static_cast<float>(std::sin(angle)), cosine = static_cast<float>(std::cos(angle));
        Level fine, coarse;
        for (const auto& [level, n] : {std::pair(&fine, 9u), std::pair(&coarse, 2u)})
        {
            addWall(*level, n, {-1, 0, 0}, {0, -1, 0});
            addWall(*level, n, {cosine, sine, 0}, {sine, -cosine, 0});
        }
        coarse.finer_vertex.assign(coarse.mesh.positions.size(), kInvalidIndex);
        std::vector<Moments> fitted;
        for (const Float3 normal : coarse.mesh.normals)
            fitted.push_back({normal.x == 0 ? 2.0f : 5.0f, {}});
        const std::vector<LevelMesh> views{fine.view(), coarse.view()};
        const std::vector<Moments> moments = interpolateFinerLevels(views, fitted)[0];
        for (size_t v = 0; v < moments.size(); ++v)
            EXPECT_NEAR(moments[v].m0, fine.mesh.normals[v].x == 0 ? 2 : 5, 1e-5) << degrees;
    }
}

TEST(InterpolateFinerLevels, givesMergedVerticesOneValue)
{
    Sphere sphere;
    // two vertices of the finest level whose normals differ, one of which the next level has, too
    Level& fine = sphere.levels[0];
    const uint32_t shared = sphere.levels[1].finer_vertex[0];
    fine.mesh.positions.push_back(fine.mesh.positions[shared]);
    fine.mesh.normals.push_back(normalizeOr(fine.mesh.normals[shared] + Float3{0.02f, 0, 0}, {}));
    fine.first_copy.push_back(shared);
    const std::vector<std::vector<Moments>> moments = sphere.interpolate();
    EXPECT_EQ(std::memcmp(&moments[0].back(), &moments[0][shared], sizeof(Moments)), 0);
    EXPECT_EQ(std::memcmp(&moments[1][0], &moments[0][shared], sizeof(Moments)), 0);
    // the same if the other one is the first
    fine.first_copy[shared] = static_cast<uint32_t>(fine.first_copy.size() - 1);
    fine.first_copy.back() = fine.first_copy[shared];
    const std::vector<std::vector<Moments>> swapped = sphere.interpolate();
    EXPECT_EQ(std::memcmp(&swapped[0].back(), &moments[1][0], sizeof(Moments)), 0);
    EXPECT_EQ(std::memcmp(&swapped[0][shared], &moments[1][0], sizeof(Moments)), 0);
}

TEST(InterpolateFinerLevels, hasTheSameBitsForAnyNumberOfThreads)
{
    const Sphere sphere;
    std::vector<std::vector<std::vector<Moments>>> results;
    for (const size_t threads : {1u, 3u})
    {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        results.push_back(sphere.interpolate());
    }
    for (size_t l = 0; l < 2; ++l)
        EXPECT_EQ(
            std::memcmp(results[0][l].data(), results[1][l].data(), results[0][l].size() * sizeof(Moments)),
            0);
}

} // namespace hearth::visibility
