// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/topology/expect_boundary.h"

#include "cook/topology/topology.h"
#include "formats/base/double3.h"
#include "tests/support/surfaces/boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace hearth::test
{

using topology::analyzeTopology;
using topology::Topology;

void expectBoundaryOfOpenMesh(const mesh::SourceMesh& mesh)
{
    const Topology topology = analyzeTopology(mesh);
    const Boundary boundary = findBoundary(topology.surface.corners);
    EXPECT_EQ(boundary.refused_triangles, 0u);
    EXPECT_EQ(topology.non_manifold_edges.size() + topology.inconsistent_edges.size(),
              boundary.complex_edges.size());
    if (!boundary.complex_edges.empty())
        return; // OpenMesh cuts these open
    std::vector<std::pair<size_t, double>> loops, expected;
    for (const topology::BoundaryLoop& loop : topology.boundary_loops)
        loops.emplace_back(loop.edgeCount(), loop.length);
    for (const BoundaryLoop& loop : boundary.loops)
    {
        double length = 0;
        for (size_t i = 0; i < loop.positions.size(); ++i)
            length += hearth::length(
                widen(topology.surface.positions[loop.positions[(i + 1) % loop.positions.size()]]) -
                widen(topology.surface.positions[loop.positions[i]]));
        expected.emplace_back(loop.positions.size(), length);
    }
    std::sort(loops.begin(), loops.end());
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(loops.size(), expected.size());
    for (size_t i = 0; i < loops.size(); ++i)
    {
        EXPECT_EQ(loops[i].first, expected[i].first);
        EXPECT_NEAR(loops[i].second, expected[i].second, 1e-9 * (1 + expected[i].second));
    }
}

} // namespace hearth::test
