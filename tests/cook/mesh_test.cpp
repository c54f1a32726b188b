// Tests welding, the exact test for degenerate triangles, open edges, the grid, and deformation data of a
// mesh.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/deformation.h"
#include "cook/mesh/edge_split.h"
#include "cook/mesh/grid.h"
#include "cook/mesh/triangles.h"
#include "cook/mesh/weld.h"
#include "formats/codecs/vertex_codec.h"
#include "tests/support/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace hearth;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(WeldPositions, joinsEqualPlacesAndBothZeros)
{
    const std::vector<Float3> positions{
        {1, 2, 3}, {0.0f, 1, 0}, {-0.0f, 1, -0.0f}, {1, 2, 3}, {1, 2, 3.0000002f}};
    const mesh::Weld weld = mesh::weldPositions(positions);
    EXPECT_THAT(weld.position_id_of_vertex, ElementsAre(0, 1, 1, 0, 2));
    EXPECT_EQ(weld.position_count, 3u);
}

TEST(WeldPositions, findsTheCubeUnderItsCharts)
{
    const mesh::SourceMesh cube = shapes::rock(1, 0);
    EXPECT_EQ(cube.vertexCount(), 24u);
    EXPECT_EQ(mesh::weldPositions(cube.positions).position_count, 8u);
}

TEST(FirstEqualVertices, comparesEveryArray)
{
    mesh::SourceMesh mesh;
    mesh.positions.assign(5, {1, 2, 3});
    mesh.normals.assign(5, {0, 0, 1});
    mesh.uvs[2].assign(5, {0.5f, 0.5f});
    mesh.joint_sets.push_back(std::vector<mesh::Joints4>(5, {{1, 2, 3, 4}}));
    mesh.weight_sets.push_back(std::vector<Float4>(5, {1, 0, 0, 0}));
    mesh.morph_targets.emplace_back().positions.assign(5, {});
    mesh.uvs[2][1] = {0.5f, 0.25f};
    mesh.joint_sets[0][2].joint[3] = 5;
    mesh.morph_targets[0].positions[3] = {0, 0, 1};
    EXPECT_THAT(mesh::firstEqualVertices(mesh), ElementsAre(0, 1, 2, 3, 0));
}

TEST(IsDegenerate, isExactOnNeedles)
{
    EXPECT_TRUE(mesh::isDegenerate({1, 1, 1}, {1, 1, 1}, {2, 3, 4}));
    EXPECT_TRUE(mesh::isDegenerate({0.1f, 0.1f, 0.1f}, {0.2f, 0.2f, 0.2f}, {0.4f, 0.4f, 0.4f}));
    // one bit off the line, far from the origin and on large and small scales
    const float third = 3.0f;
    EXPECT_FALSE(mesh::isDegenerate({1, 1, 1}, {2, 2, 2}, {third, third, std::nextafter(third, 4.0f)}));
    EXPECT_FALSE(mesh::isDegenerate({1e30f, 0, 0}, {2e30f, 0, 0}, {3e30f, 1e-38f, 0}));
    EXPECT_FALSE(mesh::isDegenerate({1e-40f, 0, 0}, {2e-40f, 0, 0}, {3e-40f, 1e-44f, 0}));
    EXPECT_TRUE(mesh::isDegenerate({1e-40f, 0, 0}, {2e-40f, 0, 0}, {4e-40f, 0, 0}));
    EXPECT_TRUE(mesh::isDegenerate({3e38f, 3e38f, 3e38f}, {-3e38f, -3e38f, -3e38f}, {0, 0, 0}));
}

TEST(IsDegenerate, agreesWithIntegerArithmetic)
{
    // small integers scaled by a power of two: the area is known exactly
    for (int i = 0; i < 4096; ++i)
    {
        const int bx = i % 8, by = i / 8 % 8, cx = i / 64 % 8, cy = i / 512;
        const bool flat = bx * cy - by * cx == 0;
        const auto at = [](int x, int y) {
            return Float3{static_cast<float>(x) * 0.125f + 1024, static_cast<float>(y), 7};
        };
        EXPECT_EQ(mesh::isDegenerate(at(0, 0), at(bx, by), at(cx, cy)), flat) << i;
    }
}

TEST(OpenEdges, areTheBorderWithItsDirection)
{
    const std::vector<uint32_t> two_triangles{0, 1, 2, 2, 1, 3};
    using mesh::OpenEdge;
    EXPECT_THAT(mesh::openEdges(two_triangles),
                ElementsAre(OpenEdge{0, 1, 1}, OpenEdge{1, 3, 1}, OpenEdge{2, 0, 1}, OpenEdge{3, 2, 1}));
    const std::vector<uint32_t> closed{0, 1, 2, 0, 3, 1, 1, 3, 2, 0, 2, 3};
    EXPECT_THAT(mesh::openEdges(closed), IsEmpty());
    const std::vector<uint32_t> wrong_way{0, 1, 2, 1, 2, 3};
    EXPECT_THAT(mesh::openEdges(wrong_way), testing::Contains(OpenEdge{1, 2, 2}));
}

TEST(SplitLongEdges, keepsTheSurfaceAndItsClosure)
{
    // a tetrahedron with edges of many lengths
    const std::vector<Float3> corners{{0, 0, 0}, {8, 0, 0}, {0, 0.5f, 0}, {1, 0.25f, 3}};
    const std::vector<uint32_t> tetrahedron{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const auto normal = [](std::span<const Float3> positions, const uint32_t* triangle)
    {
        const Float3 a = positions[triangle[0]];
        return cross(positions[triangle[1]] - a, positions[triangle[2]] - a);
    };
    for (const float longest : {9.0f, 3.0f, 1.0f, 0.3f})
    {
        const mesh::SplitSurface split = mesh::splitLongEdges(corners, tetrahedron, longest, 10000).value();
        const size_t count = split.source_triangle.size();
        EXPECT_TRUE(mesh::splitLongEdges(corners, tetrahedron, longest, count));
        EXPECT_FALSE(mesh::splitLongEdges(corners, tetrahedron, longest, count - 1));
        EXPECT_THAT(mesh::openEdges(split.indices), IsEmpty());
        std::vector<Float3> sums(4);
        for (size_t t = 0; t < split.source_triangle.size(); ++t)
        {
            const uint32_t* triangle = &split.indices[t * 3];
            for (size_t k = 0; k < 3; ++k)
                EXPECT_LE(length(split.positions[triangle[k]] - split.positions[triangle[(k + 1) % 3]]),
                          longest);
            const uint32_t source = split.source_triangle[t];
            const Float3 of_source = normal(corners, &tetrahedron[size_t{source} * 3]);
            EXPECT_GT(dot(normal(split.positions, triangle), of_source), 0);
            sums[source] += normal(split.positions, triangle);
        }
        for (size_t t = 0; t < 4; ++t)
            EXPECT_LT(length(sums[t] - normal(corners, &tetrahedron[t * 3])), 1e-3f) << longest;
        EXPECT_EQ(split.source_triangle.size() == 4, longest == 9);
    }
}

TEST(Grid, movesPositionsToMultiplesOfAPowerOfTwo)
{
    for (const float scale : {1.0f, 3e-7f, 5e9f})
    {
        mesh::SourceMesh rock = shapes::rock(20, 0.4f);
        for (Float3& p : rock.positions)
            p = p * scale + Float3{scale * 7, 0, 0};
        const mesh::SourceMesh before = rock;
        const mesh::Grid grid = mesh::snapToGrid(rock);
        int exponent = 0;
        EXPECT_EQ(std::frexp(grid.step, &exponent), 0.5);
        double farthest = 0, least = 0, most = 0;
        for (size_t v = 0; v < rock.vertexCount(); ++v)
        {
            for (int axis = 0; axis < 3; ++axis)
            {
                const double multiple = rock.positions[v][axis] / grid.step;
                EXPECT_EQ(multiple, std::round(multiple));
                EXPECT_LE(std::abs(multiple), 1 << 24);
            }
            least = std::min(least, before.positions[v].y / grid.step);
            most = std::max(most, before.positions[v].y / grid.step);
            const Float3 moved = rock.positions[v] - before.positions[v];
            farthest = std::max(farthest, static_cast<double>(std::hypot(moved.x, moved.y, moved.z)));
        }
        EXPECT_GT(most - least, 50000);
        EXPECT_LE(farthest, double{grid.error});
        EXPECT_LE(grid.error, grid.step * 0.87);
        EXPECT_GT(grid.error, grid.step * 0.5);
    }
}

TEST(Grid, isFineEnoughForShortEdges)
{
    mesh::SourceMesh mesh;
    mesh.positions = {{0, 0, 0},           {1, 0, 0}, {0, 1, 0}, {0.5f, 0.5f, 0}, {0.500001f, 0.5f, 0},
                      {0.5f, 0.500001f, 0}};
    mesh.indices = {0, 1, 2, 3, 4, 5};
    mesh::SourceMesh on_grid = mesh;
    mesh::snapToGrid(on_grid);
    EXPECT_FALSE(on_grid.positions[3] == on_grid.positions[4]);
    EXPECT_FALSE(on_grid.positions[3] == on_grid.positions[5]);
    EXPECT_FALSE(on_grid.positions[4] == on_grid.positions[5]);
}

/// Vertex with two sets of influences.
mesh::SourceMesh influenced(std::array<uint16_t, 8> joints, std::array<float, 8> weights)
{
    mesh::SourceMesh mesh;
    mesh.positions = {{0, 0, 0}};
    for (size_t set = 0; set < 2; ++set)
    {
        const uint16_t* const j = joints.data() + 4 * set;
        const float* const w = weights.data() + 4 * set;
        mesh.joint_sets.push_back({{{j[0], j[1], j[2], j[3]}}});
        mesh.weight_sets.push_back({{w[0], w[1], w[2], w[3]}});
    }
    return mesh;
}

TEST(Influences, areTheLargestInCodesThatSumToOne)
{
    mesh::SourceMesh mesh = influenced({5, 6, 7, 8, 9, 0, 0, 0}, {0.1f, 0.3f, 0.05f, 0.25f, 0.3f, 0, 0, 0});
    const mesh::InfluenceLoss loss = mesh::reduceInfluences(mesh, 4);
    EXPECT_EQ(loss.vertex_count, 1u);
    EXPECT_NEAR(loss.max_weight, 0.05, 1e-6);
    ASSERT_EQ(mesh.joint_sets.size(), 1u);
    const auto& joint = mesh.joint_sets[0][0].joint;
    EXPECT_EQ((std::array<uint16_t, 4>{joint[0], joint[1], joint[2], joint[3]}),
              (std::array<uint16_t, 4>{6, 9, 8, 5}));
    const Float4 w = mesh.weight_sets[0][0];
    EXPECT_NEAR(w.x, 0.3 / 0.95, 2e-5);
    EXPECT_NEAR(w.w, 0.1 / 0.95, 2e-5);
    long sum = 0;
    for (const float weight : {w.x, w.y, w.z, w.w})
        sum += std::lround(weight * 65535);
    EXPECT_EQ(sum, 65535);
}

TEST(Influences, ofOneJointAreAddedAndThoseWithoutWeightNameJoint0)
{
    mesh::SourceMesh mesh = influenced({5, 6, 5, 8, 5, 0, 0, 0}, {0.25f, 0.5f, 0.125f, 0, 0.125f, 0, 0, 0});
    const mesh::InfluenceLoss loss = mesh::reduceInfluences(mesh, 8);
    EXPECT_EQ(loss.vertex_count, 0u);
    ASSERT_EQ(mesh.joint_sets.size(), 1u) << "two joints need no second set";
    EXPECT_EQ(mesh.joint_sets[0][0].joint[0], 5);
    EXPECT_EQ(mesh.joint_sets[0][0].joint[1], 6);
    EXPECT_EQ(mesh.joint_sets[0][0].joint[2], 0);
    EXPECT_NEAR(mesh.weight_sets[0][0].x, 0.5, 1e-5);
}

TEST(MorphTargets, snapToStepsThatReachThem)
{
    mesh::SourceMesh mesh;
    mesh.positions.resize(2);
    mesh.normals.assign(2, {0, 0, 1});
    mesh.morph_targets.resize(2);
    mesh.morph_targets[0].positions = {{0.3f, -7.99999f, 0}, {8, 1e-7f, 0}};
    mesh.morph_targets[1].normals = {{0.1f, 3, 0}, {0, 0, 0}};
    const mesh::MorphTarget before = mesh.morph_targets[0];
    const std::vector<float> steps = mesh::snapMorphTargets(mesh);
    ASSERT_EQ(steps.size(), 2u);
    for (size_t v = 0; v < 2; ++v)
        for (int axis = 0; axis < 3; ++axis)
        {
            const float snapped = mesh.morph_targets[0].positions[v][axis];
            EXPECT_NEAR(snapped, before.positions[v][axis], steps[0]);
            EXPECT_EQ(snapped / steps[0], std::round(snapped / steps[0]));
            EXPECT_LE(std::abs(snapped / steps[0]), formats::kMaxMorphPositionSteps);
        }
    EXPECT_LE(steps[0], 16.0f / (1 << 18));
    EXPECT_EQ(mesh.morph_targets[1].positions.size(), 2u);
    EXPECT_NEAR(mesh.morph_targets[1].normals[0].x, 0.1, 1e-3);
    EXPECT_NEAR(mesh.morph_targets[1].normals[0].y, 2, 1e-3) << "no two normals are farther apart";
}

} // namespace
