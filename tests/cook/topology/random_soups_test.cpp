// Compares cook/topology with plain searches on random soups of triangles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/topology/topology.h"
#include "tests/cook/topology/topology_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace hearth::test
{

namespace
{

using namespace topology;
using reference::LatticePoint;
using reference::LatticeTriangle;
using Soup = std::vector<LatticeTriangle>;

/// Make a mesh whose triangles share no vertex, so that all connectivity is by position.
mesh::SourceMesh makeMesh(const Soup& soup)
{
    mesh::SourceMesh mesh;
    for (const LatticeTriangle& triangle : soup)
        for (const LatticePoint& p : triangle)
        {
            mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(
                {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
        }
    return mesh;
}

LatticePoint toLattice(Float3 p)
{
    return {static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z)};
}

void expectSame(const Soup& soup, uint32_t seed)
{
    SCOPED_TRACE(seed);
    const reference::TopologyFacts facts = reference::findTopology(soup);
    const Topology topology = analyzeTopology(makeMesh(soup));
    EXPECT_EQ(topology.surface.zero_area.size(), facts.zero_area);
    EXPECT_EQ(topology.surface.doubled.size(), facts.doubled);
    EXPECT_EQ(std::count_if(topology.surface.doubled.begin(), topology.surface.doubled.end(),
                            [](const DoubledTriangle& pair) { return pair.is_opposite; }),
              static_cast<ptrdiff_t>(facts.opposite_doubled));
    EXPECT_EQ(topology.components, facts.components);
    EXPECT_EQ(topology.non_manifold_edges.size(), facts.non_manifold_edges);
    EXPECT_EQ(topology.inconsistent_edges.size(), facts.inconsistent_edges);
    EXPECT_EQ(topology.t_junctions.size(), facts.t_junctions);
    EXPECT_EQ(std::count_if(topology.t_junctions.begin(), topology.t_junctions.end(),
                            [&](const TJunction& junction)
                            { return topology.edges.edges[junction.edge].count == 1; }),
              static_cast<ptrdiff_t>(facts.open_t_junctions));

    std::vector<std::pair<LatticePoint, size_t>> vertices;
    for (const NonManifoldVertex& vertex : topology.non_manifold_vertices)
        vertices.push_back({toLattice(topology.surface.positions[vertex.position]), vertex.fans});
    std::sort(vertices.begin(), vertices.end());
    EXPECT_EQ(vertices, facts.non_manifold_vertices);

    std::vector<reference::LoopFacts> loops;
    for (const BoundaryLoop& loop : topology.boundary_loops)
        loops.push_back({loop.length, loop.edgeCount(), loop.is_closed});
    // Lengths are sums in different orders: of loops of equal ones the order may differ too.
    const auto sortByEdges = [](std::vector<reference::LoopFacts>& list)
    {
        for (reference::LoopFacts& loop : list)
            loop.length = std::round(loop.length * 1e9) / 1e9;
        std::sort(list.begin(), list.end());
    };
    std::vector<reference::LoopFacts> reference_loops = facts.loops;
    sortByEdges(loops);
    sortByEdges(reference_loops);
    EXPECT_EQ(loops, reference_loops);

    std::vector<reference::ShellFacts> shells;
    for (const Shell& shell : topology.shells.shells)
    {
        reference::ShellFacts& found = shells.emplace_back();
        found = {shell.triangles, shell.is_closed, shell.is_orientable, shell.reversed, {}, {}};
        if (shell.genus)
            found.genus = static_cast<int>(*shell.genus);
        if (shell.is_closed && shell.is_orientable)
            found.volume = shell.volume;
    }
    const auto roundVolumes = [](std::vector<reference::ShellFacts>& list)
    {
        for (reference::ShellFacts& shell : list)
            if (shell.volume)
                shell.volume = std::round(*shell.volume * 1e6) / 1e6 + 0.0; // no -0
        std::sort(list.begin(), list.end());
    };
    std::vector<reference::ShellFacts> reference_shells = facts.shells;
    roundVolumes(shells);
    roundVolumes(reference_shells);
    EXPECT_EQ(shells.size(), reference_shells.size());
    EXPECT_TRUE(shells == reference_shells);
}

/// Make triangles of random corners of a lattice: hardly anything is manifold.
Soup makeSoup(std::mt19937& random, int side, int count)
{
    const auto pick = [&] { return static_cast<int>(random() % static_cast<uint32_t>(side)); };
    Soup soup;
    for (int i = 0; i < count; ++i)
    {
        LatticeTriangle& triangle = soup.emplace_back();
        for (LatticePoint& p : triangle)
            p = {pick(), pick(), pick()};
    }
    return soup;
}

/// Add the faces of a cell of the lattice, each as two triangles that face outwards.
void addCell(Soup& soup, LatticePoint at)
{
    for (size_t axis = 0; axis < 3; ++axis)
        for (const int side : {0, 1})
        {
            const auto corner = [&](int u, int v)
            {
                LatticePoint p = at;
                p[axis] += side;
                p[(axis + 1) % 3] += side == 1 ? u : v;
                p[(axis + 2) % 3] += side == 1 ? v : u;
                return p;
            };
            soup.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
            soup.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
        }
}

} // namespace

TEST(Topology, ofRandomSoupsIsThatOfPlainSearches)
{
    for (uint32_t seed = 0; seed < 120; ++seed)
    {
        std::mt19937 random(seed);
        expectSame(makeSoup(random, 2 + static_cast<int>(seed % 3), 5 + static_cast<int>(seed % 36)), seed);
        ASSERT_FALSE(HasFailure());
    }
}

TEST(Topology, ofRandomCellsIsThatOfPlainSearches)
{
    // Cells that touch in corners, edges and faces, with holes, turned triangles, and copies.
    for (uint32_t seed = 0; seed < 150; ++seed)
    {
        std::mt19937 random(seed);
        const auto pick = [&](uint32_t count) { return static_cast<int>(random() % count); };
        Soup soup;
        for (int cell = 0, count = 1 + pick(4); cell < count; ++cell)
            addCell(soup, {pick(3), pick(3), pick(2)});
        std::shuffle(soup.begin(), soup.end(), random);
        if (seed % 3 != 0)
            soup.resize(soup.size() - static_cast<size_t>(pick(6)));
        if (seed % 5 != 0)
            for (int i = pick(4); i > 0; --i)
                std::swap(soup[static_cast<size_t>(i)][0], soup[static_cast<size_t>(i)][1]);
        for (int i = pick(3); i > 0; --i)
            soup.push_back(soup[static_cast<size_t>(i)]);
        expectSame(soup, seed);
        ASSERT_FALSE(HasFailure());
    }
}

TEST(Topology, knowsHollowsOfNestedBoxesFromFlippedOnes)
{
    // A box is closed and nests in another, or stands beside it: the solids around it are known by its
    // place.
    for (uint32_t seed = 0; seed < 60; ++seed)
    {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        mesh::SourceMesh mesh;
        std::vector<ShellSide> expected;
        const auto addBox = [&](Float3 min, float size, bool is_inward)
        {
            Soup cell;
            addCell(cell, {0, 0, 0});
            for (LatticeTriangle& triangle : cell)
            {
                if (is_inward)
                    std::swap(triangle[0], triangle[1]);
                for (const LatticePoint& p : triangle)
                {
                    mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
                    mesh.positions.push_back(min + Float3{static_cast<float>(p[0]), static_cast<float>(p[1]),
                                                          static_cast<float>(p[2])} *
                                                       size);
                }
            }
        };
        for (int tower = 0; tower < 4; ++tower)
        {
            int solids = 0;
            for (int depth = 0, count = 1 + static_cast<int>(random() % 4); depth < count; ++depth)
            {
                const bool is_inward = random() % 2 == 0;
                const float inset = 1.5f * static_cast<float>(depth);
                addBox({static_cast<float>(20 * tower) + inset, inset, inset}, 16 - 2 * inset, is_inward);
                expected.push_back(!is_inward   ? ShellSide::outward
                                   : solids > 0 ? ShellSide::cavity
                                                : ShellSide::flipped);
                solids += is_inward ? -1 : 1;
            }
        }
        const Topology topology = analyzeTopology(mesh);
        ASSERT_EQ(topology.shells.shells.size(), expected.size());
        for (size_t i = 0; i < expected.size(); ++i)
            EXPECT_EQ(topology.shells.shells[i].side, expected[i]) << i;
    }
}

} // namespace hearth::test
