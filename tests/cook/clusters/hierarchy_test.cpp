// Tests the guarantees of the hierarchy on difficult meshes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/levels/validate.h"
#include "tests/support/cuts.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"
#include "tests/support/soundness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include <tbb/global_control.h>

namespace
{

using namespace hearth;
using clusters::buildHierarchy;
using clusters::Hierarchy;
using mesh::SourceMesh;

std::string getMessage(const Status& status)
{
    return status.ok() ? "" : formatMessage(status.error());
}

void expectSound(const SourceMesh& mesh, const Hierarchy& hierarchy)
{
    EXPECT_EQ(cuts::unsoundness(mesh, hierarchy), "");
}

void expectSound(const SourceMesh& mesh)
{
    expectSound(mesh, buildHierarchy(mesh));
}

double fillOfFinest(const Hierarchy& hierarchy)
{
    const auto& level = hierarchy.levels.front();
    return static_cast<double>(level.triangle_count) / (128.0 * level.clusters.count);
}

SourceMesh fromTriangles(std::vector<Float3> positions, std::vector<uint32_t> indices)
{
    SourceMesh mesh;
    mesh.positions = std::move(positions);
    mesh.indices = std::move(indices);
    mesh.triangle_materials.assign(mesh.triangleCount(), 0);
    return mesh;
}

void transform(SourceMesh& mesh, float scale, Float3 offset)
{
    for (Float3& p : mesh.positions)
        p = p * scale + offset;
}

TEST(Hierarchy, ofNothingIsEmpty)
{
    const SourceMesh mesh;
    const Hierarchy hierarchy = buildHierarchy(mesh);
    EXPECT_TRUE(hierarchy.clusters.empty());
    EXPECT_TRUE(hierarchy.levels.empty());
    EXPECT_EQ(getMessage(clusters::validateHierarchy(mesh, hierarchy)), "");
}

TEST(Hierarchy, ofOneTriangleIsOneCluster)
{
    const SourceMesh mesh = fromTriangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2});
    const Hierarchy hierarchy = buildHierarchy(mesh);
    ASSERT_EQ(hierarchy.clusters.size(), 1u);
    EXPECT_EQ(hierarchy.levels.size(), 1u);
    EXPECT_TRUE(std::isinf(hierarchy.groups[0].error));
    expectSound(mesh, hierarchy);
}

TEST(Hierarchy, dropsAndCountsTrianglesWithoutArea)
{
    // two equal corners; corners that only welding makes equal (-0); three corners exactly on a line
    const SourceMesh mesh = fromTriangles(
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0f, 0, 0}, {0.1f, 0.1f, 0.1f}, {0.2f, 0.2f, 0.2f}},
        {0, 1, 2, 0, 0, 1, 0, 3, 1, 0, 4, 5, 0, 1, 2});
    const Hierarchy hierarchy = buildHierarchy(mesh);
    EXPECT_EQ(hierarchy.mesh.degenerate_triangles, 3u);
    EXPECT_EQ(hierarchy.levels.front().triangle_count, 2u) << "the repeated triangle stays";
    expectSound(mesh, hierarchy);
}

TEST(Hierarchy, ofTrianglesWithoutAreaIsEmpty)
{
    const SourceMesh mesh = fromTriangles({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {0, 1, 2, 0, 0, 0});
    const Hierarchy hierarchy = buildHierarchy(mesh);
    EXPECT_TRUE(hierarchy.clusters.empty());
    EXPECT_EQ(hierarchy.mesh.degenerate_triangles, 2u);
    EXPECT_EQ(getMessage(clusters::validateHierarchy(mesh, hierarchy)), "");
}

TEST(Hierarchy, ofAClosedRockEndsInOneCluster)
{
    const SourceMesh mesh = shapes::rock(60, 0.4f);
    const Hierarchy hierarchy = buildHierarchy(mesh);
    expectSound(mesh, hierarchy);
    EXPECT_EQ(hierarchy.levels.back().clusters.count, 1u);
    EXPECT_GE(fillOfFinest(hierarchy), 0.97);
    EXPECT_EQ(hierarchy.counts.stuck_groups, 0u);
}

TEST(Hierarchy, ofASmoothSphereIsSound)
{
    const SourceMesh mesh = shapes::rock(50, 0);
    const Hierarchy hierarchy = buildHierarchy(mesh);
    expectSound(mesh, hierarchy);
    EXPECT_EQ(hierarchy.levels.back().clusters.count, 1u);
}

TEST(Hierarchy, ofATerrainKeepsItsBorder)
{
    const SourceMesh mesh = shapes::terrain(150);
    const Hierarchy hierarchy = buildHierarchy(mesh);
    expectSound(mesh, hierarchy);
    EXPECT_GE(fillOfFinest(hierarchy), 0.97);
    EXPECT_EQ(hierarchy.levels.back().clusters.count, 1u);
}

TEST(Hierarchy, ofAFlatGridHasNextToNoError)
{
    const SourceMesh mesh = shapes::grid(128);
    const Hierarchy hierarchy = buildHierarchy(mesh);
    expectSound(mesh, hierarchy);
    EXPECT_LT(hierarchy.levels.back().max_error, 0.01f);
}

TEST(Hierarchy, respectsSeams)
{
    const SourceMesh mesh = shapes::blocks(24);
    const Hierarchy hierarchy = buildHierarchy(mesh);
    expectSound(mesh, hierarchy);
}

TEST(Hierarchy, ofAnySizeEndsInOneCluster)
{
    for (uint32_t n = 5; n <= 40; n += test::kSanitized ? 11 : 1)
    {
        const Hierarchy of_blocks = buildHierarchy(shapes::blocks(n));
        EXPECT_EQ(of_blocks.levels.back().clusters.count, 1u) << "blocks " << n;
        const Hierarchy of_rock = buildHierarchy(shapes::rock(n, 0.5f, n));
        EXPECT_EQ(of_rock.levels.back().clusters.count, 1u) << "rock " << n;
    }
}

/// Give every triangle three vertices of its own, with the normal of its plane and no other attributes.
mesh::SourceMesh flatShaded(const mesh::SourceMesh& smooth)
{
    mesh::SourceMesh flat;
    for (size_t t = 0; t < smooth.indices.size(); t += 3)
    {
        const Float3 a = smooth.positions[smooth.indices[t]];
        const Float3 b = smooth.positions[smooth.indices[t + 1]];
        const Float3 c = smooth.positions[smooth.indices[t + 2]];
        for (const Float3 corner : {a, b, c})
        {
            flat.indices.push_back(static_cast<uint32_t>(flat.positions.size()));
            flat.positions.push_back(corner);
            flat.normals.push_back(normalizeOr(cross(b - a, c - a), {0, 0, 1}));
        }
    }
    flat.triangle_materials.assign(smooth.triangleCount(), kInvalidIndex);
    return flat;
}

TEST(Hierarchy, ofHardEdgesKeepsItsShape)
{
    mesh::SourceMesh smooth = shapes::rock(24, 0.3f);
    smooth.uvs[0].clear();
    const mesh::SourceMesh flat = flatShaded(smooth);
    const Hierarchy of_smooth = buildHierarchy(smooth);
    const Hierarchy of_flat = buildHierarchy(flat);
    expectSound(flat, of_flat);
    EXPECT_EQ(of_flat.counts.permissive_groups, 0u) << "no border of a texture is crossed";
    EXPECT_EQ(of_flat.levels.size(), of_smooth.levels.size());
    for (size_t l = 1; l < std::min(of_flat.levels.size(), of_smooth.levels.size()); ++l)
        EXPECT_LT(of_flat.levels[l].max_error, of_smooth.levels[l].max_error * 4) << "level " << l;
}

TEST(Hierarchy, mergesLooseQuadsBySpace)
{
    const SourceMesh mesh = shapes::foliage(6000);
    const Hierarchy hierarchy = buildHierarchy(mesh);
    expectSound(mesh, hierarchy);
    EXPECT_GE(fillOfFinest(hierarchy), 0.97);
    EXPECT_LE(hierarchy.levels.back().clusters.count, 4u);
}

TEST(Hierarchy, staysInTheBoxOfItsSource)
{
    // each card is as wide as the box: those that are left have no room to grow
    SourceMesh cards;
    for (int i = 0; i < 400; ++i)
    {
        SourceMesh card = shapes::grid(1);
        transform(card, 1, {0, 0, static_cast<float>(i) / 400});
        if (i == 0)
            cards = std::move(card);
        else
            shapes::append(cards, card);
    }
    for (const SourceMesh& mesh : {cards, shapes::foliage(6000), shapes::soup(3000), shapes::rock(40, 0.4f)})
    {
        const Hierarchy hierarchy = buildHierarchy(mesh);
        EXPECT_LE(cuts::measureOvershoot(hierarchy).part, 0.1);
        expectSound(mesh, hierarchy);
    }
}

/// Return the area of each level, finest first.
std::vector<double> areasOfLevels(const Hierarchy& hierarchy)
{
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    EXPECT_TRUE(decoded.ok());
    std::vector<double> areas(hierarchy.levels.size(), 0);
    for (size_t c = 0; c < hierarchy.clusters.size(); ++c)
    {
        const auto& positions = decoded->clusters[c].positions;
        const auto place = [&](size_t corner) { return decoded->positions[positions[corner]]; };
        for (size_t k = 0; k < positions.size(); k += 3)
            areas[hierarchy.clusters[c].level] +=
                length(cross(place(k + 1) - place(k), place(k + 2) - place(k))) * 0.5;
    }
    return areas;
}

TEST(Hierarchy, placesVerticesBesideTheSource)
{
    // chords of a ball lie inside it, so a well fitted level has its corners outside
    const SourceMesh ball = shapes::rock(48, 0);
    const Hierarchy hierarchy = buildHierarchy(ball);
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    ASSERT_TRUE(decoded.ok());
    float farthest = 0;
    for (const Float3 place : ball.positions)
        farthest = std::max(farthest, length(place));
    size_t outside = 0, all = 0;
    for (size_t c = 0; c < hierarchy.clusters.size(); ++c)
        for (const uint32_t position : decoded->clusters[c].positions)
            if (hierarchy.clusters[c].level == 3)
            {
                ++all;
                outside += length(decoded->positions[position]) > farthest * 1.0002f ? 1u : 0u;
            }
    EXPECT_GT(outside * 2, all);
}

TEST(Hierarchy, keepsFineNormalsWhereTheyAreSmooth)
{
    EXPECT_NE(buildHierarchy(shapes::rock(48, 0)).mesh.attributes & formats::kVertexNormal16, 0u);
    EXPECT_EQ(buildHierarchy(shapes::rock(48, 0.4f)).mesh.attributes & formats::kVertexNormal16, 0u);
}

TEST(Hierarchy, withVisibilityIsValid)
{
    clusters::Config config;
    config.visibility = true;
    for (mesh::SourceMesh source : {shapes::rock(24, 0.3f), shapes::tangle(60, 400)})
    {
        const bool has_normals = !source.normals.empty();
        const clusters::Hierarchy hierarchy = clusters::buildHierarchy(source, config);
        EXPECT_EQ((hierarchy.mesh.attributes & formats::kVertexVisibility) != 0, has_normals);
        EXPECT_EQ(getMessage(clusters::validateHierarchy(source, hierarchy)), "");
    }
}

TEST(Hierarchy, ofFoliageKeepsItsArea)
{
    const std::vector<double> areas = areasOfLevels(buildHierarchy(shapes::foliage(6000)));
    ASSERT_GE(areas.size(), 6u);
    for (size_t level = 1; level < areas.size(); ++level)
        EXPECT_NEAR(areas[level], areas[0], 0.15 * areas[0]) << "level " << level;
}

TEST(Hierarchy, mergesLooseTrianglesBySpace)
{
    const SourceMesh mesh = shapes::soup(5000);
    const Hierarchy hierarchy = buildHierarchy(mesh);
    expectSound(mesh, hierarchy);
    // 85 triangles have 255 vertices
    EXPECT_GE(fillOfFinest(hierarchy), 0.6);
    EXPECT_LE(hierarchy.levels.back().clusters.count, 4u);
}

TEST(Hierarchy, mergesIslandsBySpace)
{
    SourceMesh mesh = shapes::rock(3, 0);
    transform(mesh, 0.2f, {0, 0, 0});
    const SourceMesh pebble = mesh;
    for (int i = 1; i < 300; ++i)
    {
        SourceMesh copy = pebble;
        transform(copy, 1,
                  {static_cast<float>(i % 7), static_cast<float>(i / 7 % 7), static_cast<float>(i / 49)});
        shapes::append(mesh, copy);
    }
    const Hierarchy hierarchy = buildHierarchy(mesh);
    expectSound(mesh, hierarchy);
    EXPECT_LE(hierarchy.levels.back().clusters.count, 4u);
}

TEST(Hierarchy, ofATangleIsSound)
{
    expectSound(shapes::tangle(100, 5000));
    expectSound(shapes::tangle(2000, 5000, 2));
    expectSound(shapes::tangle(8, 3000, 3));
}

TEST(Hierarchy, ofAMoebiusStripIsSound)
{
    const SourceMesh mesh = shapes::moebius(300, 12);
    const Hierarchy hierarchy = buildHierarchy(mesh);
    expectSound(mesh, hierarchy);
    EXPECT_LE(hierarchy.levels.back().clusters.count, 2u);
}

TEST(Hierarchy, ofEveryFaceTwiceIsSound)
{
    SourceMesh mesh = shapes::rock(20, 0.3f);
    mesh.indices.insert(mesh.indices.end(), mesh.indices.begin(), mesh.indices.end());
    mesh.triangle_materials.resize(mesh.triangleCount(), 0);
    const Hierarchy hierarchy = buildHierarchy(mesh);
    expectSound(mesh, hierarchy);
    EXPECT_EQ(hierarchy.levels.front().triangle_count, mesh.triangleCount());
    EXPECT_LE(hierarchy.levels.back().clusters.count, 2u) << "doubled faces collapse together";
}

TEST(Hierarchy, ofTwoSidedFacesIsSound)
{
    SourceMesh mesh = shapes::terrain(40);
    const size_t count = mesh.indices.size();
    for (size_t i = 0; i < count; i += 3)
        mesh.indices.insert(mesh.indices.end(), {mesh.indices[i], mesh.indices[i + 2], mesh.indices[i + 1]});
    mesh.triangle_materials.resize(mesh.triangleCount(), 0);
    expectSound(mesh);
}

TEST(Hierarchy, ofOneTriangleManyTimesIsSound)
{
    SourceMesh mesh = fromTriangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {});
    for (int i = 0; i < 1000; ++i)
        mesh.indices.insert(mesh.indices.end(), {0, 1, 2});
    mesh.triangle_materials.assign(1000, 0);
    expectSound(mesh);
}

TEST(Hierarchy, ofABowTieAndFinsIsSound)
{
    SourceMesh mesh = shapes::grid(30);
    // a second sheet that touches the first at one point, and fins that stand on the sheet's edges
    SourceMesh sheet = shapes::grid(30);
    transform(sheet, 1, {1, 1, 0});
    shapes::append(mesh, sheet);
    for (uint32_t i = 0; i < 25; ++i)
    {
        const auto tip = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.push_back({static_cast<float>(i) / 30, 0.5f, 0.3f});
        mesh.normals.push_back({1, 0, 0});
        mesh.uvs[0].push_back({0, 0});
        mesh.indices.insert(mesh.indices.end(), {15 * 31 + i, 15 * 31 + i + 1, tip});
    }
    mesh.triangle_materials.resize(mesh.triangleCount(), 0);
    expectSound(mesh);
}

TEST(Hierarchy, ofAFanWithOneTipIsSound)
{
    SourceMesh mesh;
    mesh.positions.push_back({0, 0, 1});
    const uint32_t count = test::kSanitized ? 4000 : 8000;
    for (uint32_t i = 0; i < count; ++i)
    {
        const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(count);
        mesh.positions.push_back({std::cos(angle), std::sin(angle), 0});
        mesh.indices.insert(mesh.indices.end(), {0, 1 + i, 1 + (i + 1) % count});
    }
    mesh.triangle_materials.assign(count, 0);
    const Hierarchy hierarchy = buildHierarchy(mesh);
    expectSound(mesh, hierarchy);
    EXPECT_EQ(hierarchy.levels.back().clusters.count, 1u);
}

TEST(Hierarchy, ofNeedlesIsSound)
{
    SourceMesh mesh = shapes::grid(60);
    for (Float3& p : mesh.positions)
        p = {p.x * 1e4f, p.y * 1e-3f, p.x * p.y * 1e-4f};
    expectSound(mesh);
}

TEST(Hierarchy, keepsMaterialsApart)
{
    SourceMesh mesh = shapes::grid(64);
    for (uint32_t t = 0; t < mesh.triangleCount(); ++t)
    {
        const uint32_t i = t / 2 % 64, j = t / 2 / 64;
        mesh.triangle_materials[t] = (i / 8 + j / 8) % 2 == 0 ? 3 : kInvalidIndex;
    }
    const Hierarchy hierarchy = buildHierarchy(mesh);
    expectSound(mesh, hierarchy);
    // flat squares: the boundary between materials must not move at all, so the areas stay
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    ASSERT_TRUE(decoded.ok());
    for (uint32_t level = 0; level < 3; ++level)
    {
        double area = 0;
        for (uint32_t c = 0; c < hierarchy.clusters.size(); ++c)
            if (hierarchy.clusters[c].level == level && hierarchy.clusters[c].material == 3)
                for (size_t i = 0; i < decoded->clusters[c].positions.size(); i += 3)
                {
                    const auto place = [&](size_t k)
                    { return decoded->positions[decoded->clusters[c].positions[i + k]]; };
                    area += length(cross(place(1) - place(0), place(2) - place(0))) * 0.5;
                }
        EXPECT_NEAR(area, 0.5, 1e-4) << "level " << level;
    }
}

TEST(Hierarchy, ofACheckerboardOfManyMaterialsIsSound)
{
    SourceMesh mesh = shapes::grid(48);
    for (uint32_t t = 0; t < mesh.triangleCount(); ++t)
        mesh.triangle_materials[t] = t / 2 % 37;
    expectSound(mesh);
}

TEST(Hierarchy, ofHugeAndTinyCoordinatesIsSound)
{
    for (const float scale : {1e-7f, 1e-30f, 1e15f, 1e30f})
    {
        SourceMesh mesh = shapes::rock(16, 0.3f);
        transform(mesh, scale, {0, 0, 0});
        expectSound(mesh);
    }
    SourceMesh earth = shapes::terrain(60);
    transform(earth, 100, {4.2e6f, 1.3e6f, 4.6e6f});
    expectSound(earth);
}

TEST(Hierarchy, withEveryAttributeFitsItsPages)
{
    SourceMesh mesh = shapes::rock(30, 0.3f);
    for (size_t v = 0; v < mesh.vertexCount(); ++v)
    {
        const Float3 side = normalizeOr(cross(mesh.normals[v], {0.3f, 0.5f, 0.8f}), {1, 0, 0});
        mesh.tangents.push_back({side.x, side.y, side.z, v % 2 == 0 ? 1.0f : -1.0f});
        mesh.colors.push_back({0.5f + 0.5f * mesh.normals[v].x, 0.5f, 0.25f, 1});
    }
    for (size_t set = 1; set < mesh::kUvSetCount; ++set)
        mesh.uvs[set] = mesh.uvs[0];
    expectSound(mesh);
}

TEST(Hierarchy, isTheSameForAnyNumberOfThreads)
{
    const SourceMesh mesh = shapes::rock(test::kSanitized ? 40 : 90, 0.4f);
    const auto build = [&](size_t threads)
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return buildHierarchy(mesh);
    };
    const Hierarchy one = build(1);
    for (const size_t threads : {2u, 7u})
    {
        const Hierarchy many = build(threads);
        const auto same = [](const auto& a, const auto& b)
        { return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0; };
        EXPECT_TRUE(same(one.levels, many.levels));
        EXPECT_TRUE(same(one.groups, many.groups));
        EXPECT_TRUE(same(one.clusters, many.clusters));
        EXPECT_TRUE(same(one.pages, many.pages));
        EXPECT_TRUE(same(one.page_parents, many.page_parents));
        EXPECT_TRUE(same(one.page_bytes, many.page_bytes));
    }
}

TEST(Hierarchy, holdsTheCoarsestLevelInItsFirstPage)
{
    const Hierarchy hierarchy = buildHierarchy(shapes::rock(60, 0.4f));
    const auto& coarsest = hierarchy.levels.back().clusters;
    for (uint32_t c = coarsest.first; c < coarsest.first + coarsest.count; ++c)
        EXPECT_EQ(hierarchy.clusters[c].page, 0u);
    EXPECT_TRUE(hierarchy.pages.front().parents.count == 0);
}

} // namespace
