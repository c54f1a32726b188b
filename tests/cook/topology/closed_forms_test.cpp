// Tests cook/topology on surfaces whose topology is known.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/topology/topology.h"
#include "tests/cook/topology/expect_boundary.h"
#include "tests/support/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace hearth::test
{

namespace
{

using testing::ElementsAre;
using testing::IsEmpty;
using topology::analyzeTopology;
using topology::Shell;
using topology::ShellSide;
using topology::Topology;

constexpr double kPi = std::numbers::pi;

void addTriangle(mesh::SourceMesh& mesh, Float3 a, Float3 b, Float3 c)
{
    for (const Float3 p : {a, b, c})
    {
        mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(p);
    }
}

void addQuad(mesh::SourceMesh& mesh, Float3 a, Float3 b, Float3 c, Float3 d)
{
    addTriangle(mesh, a, b, c);
    addTriangle(mesh, a, c, d);
}

/// Add an axis-aligned box that faces outwards.
void addBox(mesh::SourceMesh& mesh, Float3 min, Float3 max)
{
    const auto corner = [&](int i) {
        return Float3{i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z};
    };
    for (const auto& [a, b, c, d] : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                                     std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}})
        addQuad(mesh, corner(a), corner(b), corner(c), corner(d));
}

mesh::SourceMesh makeBox(Float3 min, Float3 max)
{
    mesh::SourceMesh mesh;
    addBox(mesh, min, max);
    return mesh;
}

void turnAround(mesh::SourceMesh& mesh)
{
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

/// Append a mesh without attributes.
void append(mesh::SourceMesh& mesh, const mesh::SourceMesh& other)
{
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (const uint32_t vertex : other.indices)
        mesh.indices.push_back(first + vertex);
}

/// Make u x v quads of a surface over the unit square; parameters of its ends are passed as whole
/// turns, so that closed ones close exactly.
mesh::SourceMesh makeSurface(int u_count, int v_count, const std::function<Float3(int u, int v)>& place)
{
    mesh::SourceMesh mesh;
    for (int u = 0; u < u_count; ++u)
        for (int v = 0; v < v_count; ++v)
            addQuad(mesh, place(u, v), place(u + 1, v), place(u + 1, v + 1), place(u, v + 1));
    return mesh;
}

double turn(int i, int count)
{
    return 2 * kPi * (i % count) / count;
}

mesh::SourceMesh makeTorus(int u_count, int v_count)
{
    return makeSurface(u_count, v_count,
                       [=](int u, int v)
                       {
                           const double a = turn(u, u_count), b = turn(v, v_count);
                           const double radius = 2 + 0.5 * std::cos(b);
                           return Float3{static_cast<float>(radius * std::cos(a)),
                                         static_cast<float>(radius * std::sin(a)),
                                         static_cast<float>(0.5 * std::sin(b))};
                       });
}

/// Make a plate of cells of a mask, each a cube: its holes are handles.
mesh::SourceMesh makePlate(const std::vector<std::string>& rows)
{
    mesh::SourceMesh mesh;
    const auto isSolid = [&](int x, int y)
    {
        return y >= 0 && y < static_cast<int>(rows.size()) && x >= 0 &&
               x < static_cast<int>(rows[static_cast<size_t>(y)].size()) &&
               rows[static_cast<size_t>(y)][static_cast<size_t>(x)] == '#';
    };
    for (int y = 0; y < static_cast<int>(rows.size()); ++y)
        for (int x = 0; x < static_cast<int>(rows[0].size()); ++x)
        {
            if (!isSolid(x, y))
                continue;
            const auto at = [&](int i, int j, int k) {
                return Float3{static_cast<float>(x + i), static_cast<float>(y + j), static_cast<float>(k)};
            };
            addQuad(mesh, at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
            addQuad(mesh, at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
            if (!isSolid(x - 1, y))
                addQuad(mesh, at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
            if (!isSolid(x + 1, y))
                addQuad(mesh, at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
            if (!isSolid(x, y - 1))
                addQuad(mesh, at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
            if (!isSolid(x, y + 1))
                addQuad(mesh, at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
        }
    return mesh;
}

void expectManifold(const Topology& topology)
{
    EXPECT_THAT(topology.non_manifold_edges, IsEmpty());
    EXPECT_THAT(topology.non_manifold_vertices, IsEmpty());
    EXPECT_THAT(topology.inconsistent_edges, IsEmpty());
    EXPECT_THAT(topology.t_junctions, IsEmpty());
    EXPECT_THAT(topology.surface.doubled, IsEmpty());
}

/// Expect one shell that faces outwards.
void expectSolid(const mesh::SourceMesh& mesh, uint32_t genus, double volume)
{
    const Topology topology = analyzeTopology(mesh);
    expectManifold(topology);
    EXPECT_THAT(topology.boundary_loops, IsEmpty());
    EXPECT_EQ(topology.components, 1u);
    ASSERT_EQ(topology.shells.shells.size(), 1u);
    const Shell& shell = topology.shells.shells[0];
    EXPECT_EQ(shell.side, ShellSide::outward);
    EXPECT_EQ(shell.genus, genus);
    EXPECT_NEAR(shell.volume, volume, 1e-5 * volume);
}

std::vector<ShellSide> findSides(const mesh::SourceMesh& mesh)
{
    std::vector<ShellSide> sides;
    for (const Shell& shell : analyzeTopology(mesh).shells.shells)
        sides.push_back(shell.side);
    return sides;
}

} // namespace

TEST(Topology, ofSolidsHasTheirGenusAndVolume)
{
    expectSolid(makeBox({-1, 2, 3}, {1, 5, 7}), 0, 24);
    expectSolid(makePlate({"###", "#.#", "###"}), 1, 8);
    expectSolid(makePlate({"#####", "#.#.#", "#####"}), 2, 13);
    expectSolid(makePlate({"#######", "#.#.#.#", "#######"}), 3, 18);
    // the prismatic torus of a u-gon and a v-gon has less volume than the round one
    const Topology torus = analyzeTopology(makeTorus(256, 128));
    expectManifold(torus);
    EXPECT_EQ(torus.shells.shells[0].genus, 1u);
    EXPECT_NEAR(torus.shells.shells[0].volume, 2 * kPi * kPi * 2 * 0.25, 0.01);
    EXPECT_NEAR(torus.shells.shells[0].area, 4 * kPi * kPi * 2 * 0.5, 0.02);
    EXPECT_EQ(analyzeTopology(shapes::rock(9, 0.2f)).shells.shells[0].genus, 0u);
}

TEST(Topology, ofFarSolidsIsThatOfNearOnes)
{
    expectSolid(makeBox({8192, 8192, -8192}, {8193, 8194, -8189}), 0, 6);
}

TEST(Topology, ofAnOpenCylinderHasItsTwoLoops)
{
    constexpr int kSides = 48;
    const mesh::SourceMesh cylinder =
        makeSurface(kSides, 3,
                    [](int u, int v)
                    {
                        return Float3{static_cast<float>(std::cos(turn(u, kSides))),
                                      static_cast<float>(std::sin(turn(u, kSides))), static_cast<float>(v)};
                    });
    const Topology topology = analyzeTopology(cylinder);
    expectManifold(topology);
    ASSERT_EQ(topology.boundary_loops.size(), 2u);
    for (const topology::BoundaryLoop& loop : topology.boundary_loops)
    {
        EXPECT_TRUE(loop.is_closed);
        EXPECT_EQ(loop.edgeCount(), size_t{kSides});
        EXPECT_NEAR(loop.length, 2 * kSides * std::sin(kPi / kSides), 1e-5);
    }
    EXPECT_EQ(topology.shells.shells[0].side, ShellSide::open);
    EXPECT_EQ(topology.shells.shells[0].genus, std::nullopt);
}

TEST(Topology, ofAMoebiusStripHasOneSideAndOneLoop)
{
    const Topology topology = analyzeTopology(shapes::moebius(24, 2));
    ASSERT_EQ(topology.shells.shells.size(), 1u);
    EXPECT_FALSE(topology.shells.shells[0].is_orientable);
    ASSERT_EQ(topology.boundary_loops.size(), 1u);
    EXPECT_EQ(topology.boundary_loops[0].edgeCount(), 48u);
    EXPECT_EQ(topology.inconsistent_edges.size(), 2u); // where the strip is glued the other way round
    EXPECT_THAT(topology.non_manifold_vertices, IsEmpty());
}

TEST(Topology, ofTwoCubesThatShareAnEdge)
{
    mesh::SourceMesh mesh = makeBox({0, 0, 0}, {1, 1, 1});
    addBox(mesh, {1, 1, 0}, {2, 2, 1});
    const Topology topology = analyzeTopology(mesh);
    ASSERT_EQ(topology.non_manifold_edges.size(), 1u);
    EXPECT_EQ(topology.edges.edges[topology.non_manifold_edges[0]].count, 4u);
    EXPECT_THAT(topology.non_manifold_vertices, IsEmpty()); // its triangles share the edge
    EXPECT_EQ(topology.components, 1u);
    ASSERT_EQ(topology.shells.shells.size(), 2u);
    for (const Shell& shell : topology.shells.shells)
    {
        EXPECT_EQ(shell.side, ShellSide::outward);
        EXPECT_EQ(shell.genus, 0u);
        EXPECT_DOUBLE_EQ(shell.volume, 1);
    }
}

TEST(Topology, ofTwoCubesThatShareACorner)
{
    mesh::SourceMesh mesh = makeBox({0, 0, 0}, {1, 1, 1});
    addBox(mesh, {1, 1, 1}, {2, 2, 2});
    const Topology topology = analyzeTopology(mesh);
    EXPECT_THAT(topology.non_manifold_edges, IsEmpty());
    ASSERT_EQ(topology.non_manifold_vertices.size(), 1u);
    EXPECT_EQ(topology.non_manifold_vertices[0].fans, 2u);
    EXPECT_EQ(topology.surface.positions[topology.non_manifold_vertices[0].position], (Float3{1, 1, 1}));
    EXPECT_EQ(topology.components, 1u);
    EXPECT_EQ(topology.shells.shells.size(), 2u);
}

TEST(Topology, knowsHollowsFromFlippedShells)
{
    mesh::SourceMesh outer = makeBox({0, 0, 0}, {9, 9, 9}), inner = makeBox({3, 3, 3}, {6, 6, 6});
    mesh::SourceMesh flipped = makeBox({20, 0, 0}, {29, 9, 9});
    turnAround(inner);
    turnAround(flipped);
    mesh::SourceMesh mesh = outer;
    append(mesh, inner);
    append(mesh, flipped);
    EXPECT_THAT(findSides(mesh), ElementsAre(ShellSide::outward, ShellSide::cavity, ShellSide::flipped));
    // furniture in a room stands right, and the room is seen from within
    mesh = flipped;
    addBox(mesh, {23, 3, 3}, {26, 6, 6});
    EXPECT_THAT(findSides(mesh), ElementsAre(ShellSide::flipped, ShellSide::outward));
    // an engine with a hollow, in a car
    mesh = makeBox({-1, -1, -1}, {10, 10, 10});
    append(mesh, outer);
    append(mesh, inner);
    EXPECT_THAT(findSides(mesh), ElementsAre(ShellSide::outward, ShellSide::outward, ShellSide::cavity));
    // the hollow touches a wall from within: rays from its side there are doubtful, others are not
    for (const Float3 min : {Float3{0, 3, 3}, Float3{6, 3, 3}, Float3{3, 0, 3}, Float3{3, 6, 3}})
    {
        mesh = outer;
        inner = makeBox(min, min + Float3{3, 3, 3});
        turnAround(inner);
        append(mesh, inner);
        EXPECT_THAT(findSides(mesh), ElementsAre(ShellSide::outward, ShellSide::cavity));
    }
    // one that reaches out of the wall is none
    mesh = outer;
    inner = makeBox({3, 3, 3}, {12, 6, 6});
    turnAround(inner);
    append(mesh, inner);
    EXPECT_THAT(findSides(mesh), ElementsAre(ShellSide::outward, ShellSide::flipped));
    // nor is one that reaches from a ring into its hole
    mesh = makePlate({"###", "#.#", "###"});
    inner = makeBox({0.2f, 1.3f, 0.3f}, {1.5f, 1.6f, 0.7f});
    turnAround(inner);
    append(mesh, inner);
    EXPECT_THAT(findSides(mesh), ElementsAre(ShellSide::outward, ShellSide::flipped));
}

TEST(Topology, ofAProjectivePlaneThatIsCutOpenIsOpen)
{
    // The projective plane of six vertices. A fin at each edge of a one-sided cycle makes these edges
    // non-manifold, and the rest is a disc, whose border does not close: it meets itself the wrong way
    // round.
    mesh::SourceMesh mesh;
    const auto point = [](int i) {
        return Float3{static_cast<float>(i), static_cast<float>(i * i), static_cast<float>(i * i * i)};
    };
    for (const auto& [a, b, c] :
         {std::array{0, 1, 2}, std::array{0, 2, 3}, std::array{0, 3, 4}, std::array{0, 4, 5},
          std::array{0, 5, 1}, std::array{1, 2, 4}, std::array{2, 3, 5}, std::array{3, 4, 1},
          std::array{4, 5, 2}, std::array{5, 1, 3}})
        addTriangle(mesh, point(a), point(b), point(c));
    const Topology whole = analyzeTopology(mesh);
    ASSERT_EQ(whole.shells.shells.size(), 1u);
    EXPECT_TRUE(whole.shells.shells[0].is_closed);
    EXPECT_EQ(whole.shells.shells[0].side, ShellSide::unclear);
    addTriangle(mesh, point(0), point(1), point(7));
    addTriangle(mesh, point(1), point(3), point(8));
    addTriangle(mesh, point(3), point(0), point(9));
    const Topology cut = analyzeTopology(mesh);
    EXPECT_EQ(cut.non_manifold_edges.size(), 3u);
    ASSERT_EQ(cut.shells.shells.size(), 4u);
    EXPECT_TRUE(cut.shells.shells[0].is_orientable);
    EXPECT_FALSE(cut.shells.shells[0].is_closed);
}

TEST(Topology, countsTrianglesThatFaceTheOtherSide)
{
    mesh::SourceMesh mesh = shapes::rock(8, 0.1f);
    const Topology right = analyzeTopology(mesh);
    std::swap(mesh.indices[30], mesh.indices[31]);
    const Topology one = analyzeTopology(mesh);
    EXPECT_EQ(one.inconsistent_edges.size(), 3u);
    EXPECT_EQ(one.shells.shells[0].reversed, 1u);
    EXPECT_EQ(one.shells.shells[0].side, ShellSide::outward);
    EXPECT_EQ(one.shells.shells[0].volume, right.shells.shells[0].volume);
}

TEST(Topology, findsDoubledShellsOfBothSides)
{
    mesh::SourceMesh sheet = shapes::grid(3), back = sheet;
    back.indices = sheet.indices;
    mesh::SourceMesh same = sheet, opposite = sheet;
    append(same, sheet);
    turnAround(back);
    append(opposite, back);
    for (const bool is_opposite : {false, true})
    {
        const Topology topology = analyzeTopology(is_opposite ? opposite : same);
        ASSERT_EQ(topology.surface.doubled.size(), 18u);
        EXPECT_EQ(topology.surface.doubled[4], (topology::DoubledTriangle{4, 22, is_opposite}));
        ASSERT_EQ(topology.shells.shells.size(), 1u);
        EXPECT_EQ(topology.shells.shells[0].doubled, 18u);
        // the sheet is judged once
        ASSERT_EQ(topology.boundary_loops.size(), 1u);
        EXPECT_NEAR(topology.boundary_loops[0].length, 4, 1e-6);
        EXPECT_THAT(topology.non_manifold_edges, IsEmpty());
    }
}

TEST(Topology, ofALeafOfTwoSidesIsFlat)
{
    mesh::SourceMesh mesh;
    const Float3 a{0, 0, 0}, b{1, 0, 0.2f}, c{1.3f, 1, 0.1f};
    const Float3 d = a + (c - b);
    addQuad(mesh, a, b, c, d);
    addTriangle(mesh, d, b, a); // the other diagonal
    addTriangle(mesh, d, c, b);
    EXPECT_THAT(findSides(mesh), ElementsAre(ShellSide::flat));
}

TEST(Topology, findsTJunctionsOfGridsOfTwoStepsAndNoOthers)
{
    for (const int steps : {2, 3, 5, 7})
    {
        // a strip of quads beside one whose quads are `steps` times as fine
        mesh::SourceMesh mesh;
        constexpr int kQuads = 6;
        const auto addStrip = [&](int count, float z)
        {
            append(mesh, makeSurface(count, 1,
                                     [&](int u, int v)
                                     {
                                         const double x = static_cast<double>(u) / count;
                                         return Float3{static_cast<float>(0.3 + 4.1 * x),
                                                       static_cast<float>(1.7 - 2.9 * x),
                                                       z + static_cast<float>(v)};
                                     }));
        };
        addStrip(kQuads, 0);
        addStrip(kQuads * steps, 1);
        const Topology topology = analyzeTopology(mesh);
        EXPECT_EQ(topology.t_junctions.size(), size_t{kQuads} * static_cast<size_t>(steps - 1));
        for (const topology::TJunction& junction : topology.t_junctions)
            EXPECT_EQ(topology.edges.edges[junction.edge].count, 1u);
    }
    EXPECT_THAT(analyzeTopology(shapes::grid(20)).t_junctions, IsEmpty());
    EXPECT_THAT(analyzeTopology(shapes::terrain(20)).t_junctions, IsEmpty());
}

TEST(Topology, takesNearVerticesForTJunctionsByTheToleranceOnly)
{
    for (const double distance : {0.5, 2.0})
    {
        mesh::SourceMesh mesh;
        addTriangle(mesh, {0, 0, 0}, {1000, 0, 0}, {0, 1000, 0});
        const double tolerance = analyzeTopology(mesh).t_junction_tolerance;
        EXPECT_NEAR(tolerance, 1e-6 * std::sqrt(2e6), 1e-9);
        addTriangle(mesh, {400, static_cast<float>(-distance * tolerance), 0}, {500, -100, 0},
                    {300, -100, 0});
        EXPECT_EQ(analyzeTopology(mesh).t_junctions.size(), distance < 1 ? 1u : 0u);
    }
}

TEST(Topology, takesNeedlesForNoTJunctions)
{
    mesh::SourceMesh mesh;
    addTriangle(mesh, {0, 0, 0}, {1000, 0, 0}, {0, 1000, 0});
    addTriangle(mesh, {1000, 0, 0}, {0, 0, 0}, {500, -1e-4f, 0});
    EXPECT_THAT(analyzeTopology(mesh).t_junctions, IsEmpty());
}

TEST(Topology, countsTrianglesWithoutAreaAndVerticesWithoutUse)
{
    mesh::SourceMesh mesh = shapes::grid(2);
    const auto used = static_cast<uint32_t>(mesh.vertexCount());
    mesh.indices.insert(mesh.indices.end(), {0, 0, 1, 0, 1, 2});
    mesh.positions[2] = mesh.positions[0] + (mesh.positions[1] - mesh.positions[0]) * 2;
    mesh = {.positions = mesh.positions, .indices = mesh.indices};
    mesh.positions.push_back({7, 7, 7});
    mesh.positions.push_back(mesh.positions[3]);
    const Topology topology = analyzeTopology(mesh);
    EXPECT_THAT(topology.surface.zero_area, ElementsAre(8, 9));
    EXPECT_THAT(topology.unreferenced_vertices, ElementsAre(used, used + 1));
    EXPECT_EQ(topology.duplicate_vertices, 1u);
}

TEST(Topology, ofNothingIsNothing)
{
    EXPECT_THAT(analyzeTopology({}).shells.shells, IsEmpty());
    mesh::SourceMesh mesh;
    addTriangle(mesh, {1, 1, 1}, {1, 1, 1}, {1, 1, 1});
    EXPECT_EQ(analyzeTopology(mesh).surface.zero_area.size(), 1u);
    EXPECT_EQ(analyzeTopology(mesh).components, 0u);
}

TEST(Topology, hasTheBoundariesThatOpenMeshHas)
{
    for (const mesh::SourceMesh& mesh :
         {shapes::rock(6, 0.3f), shapes::terrain(13), shapes::foliage(50), shapes::blocks(5), shapes::grid(7),
          shapes::moebius(9, 3), shapes::soup(100), makeTorus(12, 8), shapes::tangle(60, 40),
          shapes::tangle(30, 200)})
        expectBoundaryOfOpenMesh(mesh);
    // a grid with holes, some of which touch in a corner
    for (uint32_t seed = 0; seed < 40; ++seed)
    {
        SCOPED_TRACE(seed);
        mesh::SourceMesh mesh = shapes::terrain(12, seed + 1);
        uint32_t state = seed;
        std::vector<uint32_t> kept;
        for (size_t t = 0; t < mesh.triangleCount(); ++t)
        {
            state = state * 1664525u + 1013904223u;
            if (state >> 29 != 0)
                kept.insert(kept.end(),
                            {mesh.indices[3 * t], mesh.indices[3 * t + 1], mesh.indices[3 * t + 2]});
        }
        mesh.indices = kept;
        expectBoundaryOfOpenMesh(mesh);
    }
}

} // namespace hearth::test
