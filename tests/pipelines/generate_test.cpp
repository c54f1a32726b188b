// Tests the generation of normals and tangents for sources without them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/generate_normals.h"
#include "pipelines/import/part/generate_tangents.h"
#include "pipelines/import/part/mesh_pieces.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <tbb/global_control.h>

namespace hearth::import
{

namespace
{

constexpr float kPi = std::numbers::pi_v<float>;

/// Cube of 8 vertices and 12 triangles, facing outward.
mesh::SourceMesh cube()
{
    mesh::SourceMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back(
            {static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1), static_cast<float>(i >> 2)});
    mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    mesh.triangle_materials.assign(12, kInvalidIndex);
    return mesh;
}

/// Sphere as rows of quads; u runs around, v down.
mesh::SourceMesh sphere(uint32_t rows, uint32_t columns)
{
    mesh::SourceMesh mesh;
    for (uint32_t row = 0; row <= rows; ++row)
        for (uint32_t column = 0; column <= columns; ++column)
        {
            const float v = static_cast<float>(row) / static_cast<float>(rows);
            const float u = static_cast<float>(column) / static_cast<float>(columns);
            const float a = u * 2 * kPi;
            const float radius = row == rows ? 0 : std::sin(v * kPi); // sin(pi) is not quite 0
            mesh.positions.push_back({radius * std::cos(a), std::cos(v * kPi), -radius * std::sin(a)});
            mesh.uvs[0].push_back({u, v});
        }
    for (uint32_t row = 0; row < rows; ++row)
        for (uint32_t column = 0; column < columns; ++column)
        {
            const uint32_t a = row * (columns + 1) + column;
            const uint32_t b = a + columns + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
    mesh.triangle_materials.assign(mesh.indices.size() / 3, kInvalidIndex);
    return mesh;
}

Float3 faceNormal(const mesh::SourceMesh& mesh, size_t triangle)
{
    const uint32_t* c = mesh.indices.data() + triangle * 3;
    return normalizeOr(
        cross(mesh.positions[c[1]] - mesh.positions[c[0]], mesh.positions[c[2]] - mesh.positions[c[0]]), {});
}

std::vector<Float3> corners(const mesh::SourceMesh& mesh)
{
    std::vector<Float3> result;
    for (const uint32_t index : mesh.indices)
        result.push_back(mesh.positions[index]);
    return result;
}

TEST(GenerateNormals, keepsTheEdgesOfACubeHard)
{
    mesh::SourceMesh mesh = cube();
    generateNormals(mesh, kPi / 3);
    EXPECT_EQ(mesh.vertexCount(), 24u);
    for (size_t i = 0; i < mesh.indices.size(); ++i)
        EXPECT_GT(dot(mesh.normals[mesh.indices[i]], faceNormal(mesh, i / 3)), 0.99999f);
    EXPECT_EQ(corners(mesh), corners(cube()));
}

TEST(GenerateNormals, averagesWhatTheCreaseAngleAllows)
{
    mesh::SourceMesh mesh = cube();
    generateNormals(mesh, kPi);
    EXPECT_EQ(mesh.vertexCount(), 8u);
    for (size_t i = 0; i < mesh.vertexCount(); ++i)
    {
        const Float3 out = mesh.positions[i] - Float3{0.5f, 0.5f, 0.5f};
        // every corner has three sides, of one or two triangles each, with equal area
        EXPECT_GT(dot(mesh.normals[i], normalizeOr(out, {})), 0.8f);
        EXPECT_NEAR(length(mesh.normals[i]), 1, 1e-6);
    }
}

TEST(GenerateNormals, isSmoothOnASphereAlsoAcrossItsSeam)
{
    mesh::SourceMesh mesh = sphere(16, 32);
    generateNormals(mesh, kPi / 3);
    for (size_t i = 0; i < mesh.vertexCount(); ++i)
        EXPECT_GT(dot(mesh.normals[i], mesh.positions[i]), 0.99f);
}

TEST(GenerateNormals, isSmoothOnASoupOfTriangles)
{
    mesh::SourceMesh soup = sphere(16, 32);
    std::vector<uint32_t> old_from_new = soup.indices;
    gatherVertices(soup, old_from_new);
    for (uint32_t i = 0; i < soup.indices.size(); ++i)
        soup.indices[i] = i;
    generateNormals(soup, kPi / 3);
    for (size_t i = 0; i < soup.vertexCount(); ++i)
        EXPECT_GT(dot(soup.normals[i], soup.positions[i]), 0.99f);
}

TEST(GenerateNormals, givesTrianglesWithoutAreaAUnitNormal)
{
    mesh::SourceMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}};
    mesh.indices = {0, 1, 2, 3, 3, 3};
    mesh.triangle_materials = {0, 0};
    generateNormals(mesh, kPi / 3);
    for (const Float3 normal : mesh.normals)
        EXPECT_NEAR(length(normal), 1, 1e-6);
    EXPECT_EQ(mesh.triangleCount(), 2u);
}

TEST(GenerateNormals, carriesAllAttributesToSplitVertices)
{
    mesh::SourceMesh mesh = cube();
    for (uint32_t i = 0; i < 8; ++i)
    {
        const auto value = static_cast<float>(i);
        mesh.uvs[1].push_back({value, 0});
        mesh.colors.push_back({value, 0, 0, 0});
    }
    mesh.joint_sets.resize(1);
    mesh.weight_sets.resize(1);
    mesh.morph_targets.resize(1);
    for (uint16_t i = 0; i < 8; ++i)
    {
        mesh.joint_sets[0].push_back({{i, 0, 0, 0}});
        mesh.weight_sets[0].push_back({1, 0, 0, 0});
        mesh.morph_targets[0].positions.push_back({static_cast<float>(i), 0, 0});
    }
    generateNormals(mesh, 0);
    ASSERT_EQ(mesh.vertexCount(), 24u);
    for (size_t i = 0; i < 24; ++i)
    {
        const Float3 p = mesh.positions[i];
        const float old = p.x + 2 * p.y + 4 * p.z;
        EXPECT_EQ(mesh.uvs[1][i].x, old);
        EXPECT_EQ(mesh.colors[i].x, old);
        EXPECT_EQ(mesh.joint_sets[0][i].joint[0], static_cast<uint16_t>(old));
        EXPECT_EQ(mesh.morph_targets[0].positions[i].x, old);
    }
}

TEST(GenerateNormals, isLinearInTheTrianglesOfAFan)
{
    // a cone of 200 000 triangles: comparing all pairs would be 4e10 steps
    mesh::SourceMesh mesh;
    constexpr uint32_t kCount = test::kSanitized ? 20000 : 200000;
    mesh.positions.push_back({0, 0.1f, 0});
    for (uint32_t i = 0; i < kCount; ++i)
    {
        const float a = 2 * kPi * static_cast<float>(i) / kCount;
        mesh.positions.push_back({std::cos(a), 0, -std::sin(a)});
        mesh.indices.insert(mesh.indices.end(), {0, 1 + i, 1 + (i + 1) % kCount});
    }
    mesh.triangle_materials.assign(kCount, 0);
    generateNormals(mesh, kPi / 3);
    EXPECT_EQ(mesh.triangleCount(), size_t{kCount});
    for (size_t i = 0; i < mesh.vertexCount(); ++i)
        EXPECT_GT(mesh.normals[i].y, 0.9f);
}

TEST(GenerateTangents, followTheUvsAtRightAnglesToTheNormal)
{
    mesh::SourceMesh mesh = sphere(16, 32);
    generateNormals(mesh, kPi / 3);
    generateTangents(mesh, 0);
    ASSERT_EQ(mesh.tangents.size(), mesh.vertexCount());
    for (size_t i = 0; i < mesh.vertexCount(); ++i)
    {
        const Float4 t = mesh.tangents[i];
        const Float3 tangent{t.x, t.y, t.z};
        EXPECT_NEAR(length(tangent), 1, 1e-5);
        EXPECT_NEAR(dot(tangent, mesh.normals[i]), 0, 1e-4);
        EXPECT_EQ(t.w, 1.0f);
        if (std::abs(mesh.positions[i].y) > 0.9f)
            continue;
        // u runs around the axis, eastwards; the bitangent of an image that is not mirrored points up
        const float a = mesh.uvs[0][i].x * 2 * kPi;
        EXPECT_GT(dot(tangent, Float3{-std::sin(a), 0, -std::cos(a)}), 0.98f);
        EXPECT_GT(cross(mesh.normals[i], tangent).y, 0.0f);
    }
}

TEST(GenerateTangents, splitVerticesWhereUvsAreMirrored)
{
    // two squares that share an edge; the second shows the first one's image mirrored
    mesh::SourceMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
    mesh.uvs[0] = {{0, 1}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {0, 0}};
    mesh.normals.assign(6, {0, 0, 1});
    mesh.indices = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    mesh.triangle_materials.assign(4, 0);
    const std::vector<Float3> before = corners(mesh);
    generateTangents(mesh, 0);
    EXPECT_EQ(mesh.vertexCount(), 8u);
    EXPECT_EQ(corners(mesh), before);
    for (size_t i = 0; i < mesh.indices.size(); ++i)
    {
        const Float4 t = mesh.tangents[mesh.indices[i]];
        EXPECT_NEAR(t.x, i < 6 ? 1 : -1, 1e-6);
        EXPECT_EQ(t.w, i < 6 ? 1.0f : -1.0f);
        // up in the image is up in space on both sides
        const Float3 bitangent = cross(mesh.normals[mesh.indices[i]], {t.x, t.y, t.z}) * t.w;
        EXPECT_NEAR(bitangent.y, 1, 1e-6);
    }
}

TEST(GenerateTangents, giveUvsWithoutAreaSomeTangent)
{
    mesh::SourceMesh mesh = cube();
    generateNormals(mesh, 0);
    mesh.uvs[2].assign(mesh.vertexCount(), {0.5f, 0.5f});
    generateTangents(mesh, 2);
    for (size_t i = 0; i < mesh.vertexCount(); ++i)
    {
        const Float4 t = mesh.tangents[i];
        EXPECT_NEAR(length(Float3{t.x, t.y, t.z}), 1, 1e-6);
        EXPECT_NEAR(dot({t.x, t.y, t.z}, mesh.normals[i]), 0, 1e-6);
    }
}

TEST(GenerateTangents, surviveRandomSoup)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1, 1);
    mesh::SourceMesh mesh;
    for (uint32_t i = 0; i < 3000; ++i)
    {
        mesh.positions.push_back({uniform(random), uniform(random), i % 5 == 0 ? 1e9f : uniform(random)});
        mesh.uvs[0].push_back(
            {uniform(random) * (i % 7 == 0 ? 1e30f : 1), i % 11 == 0 ? 0 : uniform(random)});
        mesh.indices.push_back(i % 13 == 0 ? 0 : i);
    }
    mesh.triangle_materials.assign(1000, 0);
    generateNormals(mesh, 1);
    generateTangents(mesh, 0);
    for (size_t i = 0; i < mesh.vertexCount(); ++i)
    {
        EXPECT_NEAR(length(mesh.normals[i]), 1, 1e-5);
        EXPECT_NEAR(length(Float3{mesh.tangents[i].x, mesh.tangents[i].y, mesh.tangents[i].z}), 1, 1e-5);
    }
    for (const uint32_t index : mesh.indices)
        ASSERT_LT(index, mesh.vertexCount());
}

} // namespace

/// More triangles than one block of work, and vertices whose sums would reveal another order.
TEST(GenerateTangents, andNormalsAreTheSameForAnyNumberOfThreads)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> bump(0.9f, 1.1f);
    mesh::SourceMesh source = sphere(200, 180); // of several blocks of triangles
    for (Float3& position : source.positions)
        position = position * bump(random);
    ASSERT_GT(source.triangleCount(), 65536u);
    const auto run = [&](size_t threads)
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        mesh::SourceMesh mesh = source;
        generateNormals(mesh, kPi);
        generateTangents(mesh, 0);
        return mesh;
    };
    const mesh::SourceMesh one = run(1), four = run(4);
    EXPECT_TRUE(one.normals == four.normals);
    EXPECT_TRUE(one.tangents == four.tangents);
    EXPECT_TRUE(one.indices == four.indices);
}

} // namespace hearth::import
