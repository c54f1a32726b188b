// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/scans/triangulate.h"
#include "tests/pipelines_scans/scan_test_tools.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <random>

namespace hearth::import
{

namespace
{

using namespace test;
std::vector<uint32_t> triangulated(const std::vector<Float3>& corners)
{
    std::vector<uint32_t> triangles;
    triangulatePolygon(corners, triangles);
    return triangles;
}

Float3 computeArea(Float3 a, Float3 b, Float3 c)
{
    return cross(b - a, c - a) * 0.5f;
}

/// Return the sum of the triangles' areas, signed along `up`, or unsigned.
struct Areas
{
    float along = 0;
    float all = 0;
};

Areas computeAreas(const std::vector<Float3>& corners, const std::vector<uint32_t>& triangles, Float3 up)
{
    Areas areas;
    for (size_t t = 0; t < triangles.size(); t += 3)
    {
        const Float3 area =
            computeArea(corners[triangles[t]], corners[triangles[t + 1]], corners[triangles[t + 2]]);
        areas.along += dot(area, up);
        areas.all += length(area);
    }
    return areas;
}

/// Return a star-shaped polygon with random radii, strongly concave, in a tilted plane.
std::vector<Float3> randomStar(uint32_t corners, uint32_t seed, Float3 u, Float3 v)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> radius(0.1f, 1);
    std::vector<Float3> polygon;
    for (uint32_t i = 0; i < corners; ++i)
    {
        const float angle =
            static_cast<float>(i) / static_cast<float>(corners) * 2 * std::numbers::pi_v<float>;
        const float r = radius(random);
        polygon.push_back(u * (r * std::cos(angle)) + v * (r * std::sin(angle)));
    }
    return polygon;
}

TEST(TriangulatePolygon, fillsConcavePolygonsExactly)
{
    const Float3 u{0.6f, 0.8f, 0};
    const Float3 v = cross(normalizeOr({0.3f, -0.2f, 1}, {}), u);
    const Float3 up = normalizeOr(cross(u, v), {});
    for (uint32_t seed = 0; seed < 200; ++seed)
    {
        const uint32_t count = 5 + seed % 60;
        const std::vector<Float3> corners = randomStar(count, seed, u, v);
        const std::vector<uint32_t> triangles = triangulated(corners);
        ASSERT_EQ(triangles.size(), (count - 2) * 3);
        float outline = 0;
        for (uint32_t i = 0; i < count; ++i)
            outline += dot(computeArea({}, corners[i], corners[(i + 1) % count]), up);
        const Areas areas = computeAreas(corners, triangles, up);
        // no triangle is flipped, and the areas sum to the polygon's: none overlap and none stick out
        EXPECT_NEAR(areas.along, outline, 1e-4f) << seed;
        EXPECT_NEAR(areas.all, outline, 1e-4f) << seed;
    }
}

TEST(TriangulatePolygon, everyEdgeOfThePolygonIsUsedOnce)
{
    const std::vector<Float3> corners = randomStar(40, 3, {1, 0, 0}, {0, 0, 1});
    const std::vector<uint32_t> triangles = triangulated(corners);
    for (uint32_t i = 0; i < 40; ++i)
    {
        int found = 0;
        for (size_t t = 0; t < triangles.size(); t += 3)
            for (size_t k = 0; k < 3; ++k)
                found += triangles[t + k] == i && triangles[t + (k + 1) % 3] == (i + 1) % 40 ? 1 : 0;
        EXPECT_EQ(found, 1) << i;
    }
}

TEST(TriangulatePolygon, aBridgeToAHoleIsFollowed)
{
    // a square with a square hole, joined by a bridge edge that is traversed twice
    const std::vector<Float3> corners = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                         {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
    const Areas areas = computeAreas(corners, triangulated(corners), {0, 0, 1});
    EXPECT_NEAR(areas.along, 12, 1e-5f);
    EXPECT_NEAR(areas.all, 12, 1e-5f);
}

TEST(TriangulatePolygon, takesTheDiagonalInsideAConcaveQuad)
{
    // an arrowhead: the corner at 3 points inwards, so that only the diagonal 1-3 is inside
    const std::vector<Float3> corners = {{0, 0, 0}, {2, -1, 0}, {0, 3, 0}, {0.5f, 0.5f, 0}};
    for (size_t turn = 0; turn < 4; ++turn)
    {
        std::vector<Float3> turned = corners;
        std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(turn), turned.end());
        const Areas areas = computeAreas(turned, triangulated(turned), {0, 0, 1});
        EXPECT_NEAR(areas.along, areas.all, 1e-6f) << turn;
    }
}

TEST(TriangulatePolygon, takesTheShorterDiagonalOfAConvexQuad)
{
    EXPECT_EQ(triangulated({{0, 0, 0}, {10, 0, 0}, {11, 1, 0}, {1, 1, 0}}),
              (std::vector<uint32_t>{0, 1, 3, 1, 2, 3}));
    EXPECT_EQ(triangulated({{1, 0, 0}, {11, 0, 0}, {10, 1, 0}, {0, 1, 0}}),
              (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(TriangulatePolygon, degeneratePolygonsGiveAsManyTriangles)
{
    EXPECT_EQ(triangulated(std::vector<Float3>(7, Float3{1, 2, 3})).size(), 15u);
    EXPECT_EQ(triangulated({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}).size(), 9u);
    // a figure of eight
    EXPECT_EQ(triangulated({{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 12u);
}

/// Returns a polygon of 2 * teeth + 2 corners: half of them are concave and no ear is near.
std::vector<Float3> comb(int teeth)
{
    std::vector<Float3> corners;
    for (int i = 0; i < teeth; ++i)
    {
        corners.push_back({static_cast<float>(i), 0, 0});
        corners.push_back({static_cast<float>(i) + 0.5f, 100, 0});
    }
    corners.push_back({static_cast<float>(teeth), 200, 0});
    corners.push_back({0, 200, 0});
    return corners;
}

/// Return the CPU seconds for the polygon.
double measureSeconds(const std::vector<Float3>& corners)
{
    const std::clock_t start = std::clock();
    EXPECT_EQ(triangulated(corners).size(), (corners.size() - 2) * 3);
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

TEST(TriangulatePolygon, hugePolygonsTakeTimeInProportion)
{
    // testing every corner for every ear would take four times as long for twice the corners; other programs
    // may take the processor from any run, but hardly from all
    constexpr int kTeeth = 4000, kRepeats = hearth::test::kSanitized ? 3 : 10;
    double half = measureSeconds(comb(kTeeth)), whole = measureSeconds(comb(2 * kTeeth));
    for (int i = 1; i < kRepeats; ++i)
    {
        half = std::min(half, measureSeconds(comb(kTeeth)));
        whole = std::min(whole, measureSeconds(comb(2 * kTeeth)));
    }
    EXPECT_LT(whole, 3 * half);
}

mesh::SourceMesh meshOfObj(const std::string& text)
{
    auto file = readText(readObj, text);
    EXPECT_TRUE(file.ok());
    file->face_materials.resize(file->face_ends.size(), kInvalidIndex);
    return meshFromScan(std::move(file).value());
}

TEST(MeshFromScan, givesEveryDistinctCornerAVertex)
{
    const mesh::SourceMesh mesh = meshOfObj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 9 9 9\nvt 0 0\nvt 1 1\n"
                                            "f 1/1 2/1 3/1\nf 3/1 2/2 4/1\nf 1/1 2/1 3/1\n");
    EXPECT_EQ(mesh.vertexCount(), 5u); // 1/1 2/1 3/1 2/2 4/1; the fifth position is not used
    EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{0, 1, 2, 2, 3, 4, 0, 1, 2}));
    EXPECT_EQ(mesh.uvs[0][3], (Float2{1, 0}));
    EXPECT_EQ(mesh.source_vertex_count, 5u);
    EXPECT_EQ(mesh.face_count, 3u);
}

TEST(MeshFromScan, keepsTheOrderOfPositionsAndDropsUnused)
{
    const mesh::SourceMesh mesh = meshOfObj("v 5 5 5\nv 0 0 0 1 0 0\nv 1 0 0\nv 7 7 7\nv 0 1 0\nf 5 3 2\n");
    EXPECT_EQ(mesh.positions, (std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.colors[0], (Float4{1, 0, 0, 1}));
    EXPECT_EQ(mesh.colors.size(), 3u);
    EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{2, 1, 0}));
    EXPECT_TRUE(mesh.normals.empty());
}

TEST(MeshFromScan, normalsAreUnitAndMissingOnesAreFilledIn)
{
    const mesh::SourceMesh mesh = meshOfObj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 3 0 0\nvn 0 0 0\nf 1//1 2//2 3\n");
    ASSERT_EQ(mesh.normals.size(), 3u);
    EXPECT_EQ(mesh.normals[0], (Float3{1, 0, 0}));
    EXPECT_EQ(mesh.normals[1], (Float3{0, 0, 1}));
    EXPECT_EQ(mesh.normals[2], (Float3{0, 0, 1}));
}

TEST(MeshFromScan, trianglesOfAPolygonShareItsMaterial)
{
    auto file =
        readText(readObj, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl a\nf 1 2 3 4\nusemtl b\nf 1 2 3\n");
    const mesh::SourceMesh mesh = meshFromScan(std::move(file).value());
    EXPECT_EQ(mesh.triangle_materials, (std::vector<uint32_t>{0, 0, 1}));
    EXPECT_EQ(mesh.face_count, 2u);
}

} // namespace

} // namespace hearth::import
