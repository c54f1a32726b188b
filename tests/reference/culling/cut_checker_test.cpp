// Tests that the cut checker finds cracks and overlaps.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/culling/cut_checker.h"

#include <gtest/gtest.h>

namespace hearth::reference
{
namespace
{

/// A height field of cells x cells quads over the unit square, with a flat border.
Triangles sheet(int cells)
{
    const auto point = [&](int x, int y)
    {
        const float u = static_cast<float>(x) / static_cast<float>(cells);
        const float v = static_cast<float>(y) / static_cast<float>(cells);
        return Float3{u, 0.2f * u * (1 - u) * v * (1 - v), v};
    };
    Triangles triangles;
    for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x)
        {
            triangles.push_back({point(x, y), point(x, y + 1), point(x + 1, y + 1)});
            triangles.push_back({point(x, y), point(x + 1, y + 1), point(x + 1, y)});
        }
    return triangles;
}

Triangles tetrahedron()
{
    const Float3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0, 0, 1};
    return {{a, c, b}, {a, b, d}, {a, d, c}, {b, c, d}};
}

TEST(CheckEdges, findsNothingInTheSourceItself)
{
    const EdgeReport closed = checkEdges(tetrahedron(), tetrahedron(), 0);
    EXPECT_EQ(closed.edges, 6u);
    EXPECT_EQ(closed.open_edges, 0u);
    const EdgeReport open = checkEdges(sheet(8), sheet(8), 0);
    EXPECT_EQ(open.open_edges, 32u);
    EXPECT_EQ(open.cracks, 0u);
}

TEST(CheckEdges, findsAMissingTriangle)
{
    Triangles cut = tetrahedron();
    cut.pop_back();
    EXPECT_EQ(checkEdges(cut, tetrahedron(), 0).cracks, 3u);
    Triangles holed = sheet(8);
    holed.erase(holed.begin() + 60);
    EXPECT_EQ(checkEdges(holed, sheet(8), 1e-3).cracks, 3u);
}

TEST(CheckEdges, findsATurnedTriangle)
{
    Triangles cut = tetrahedron();
    std::swap(cut[0][0], cut[0][1]);
    EXPECT_EQ(checkEdges(cut, tetrahedron(), 0).cracks, 3u);
}

TEST(CheckEdges, findsAVertexThatMovedByOneBit)
{
    Triangles cut = tetrahedron();
    cut[3][0].x = std::nextafter(cut[3][0].x, 2.0f);
    EXPECT_EQ(checkEdges(cut, tetrahedron(), 0).cracks, 4u);
}

TEST(CheckEdges, findsATJunction)
{
    // One coarse quad beside finer ones: the edges on both sides of their common border differ.
    Triangles cut;
    for (const auto& t : sheet(8))
        if (t[0].x >= 0.5f - 1e-6f && t[1].x >= 0.5f - 1e-6f && t[2].x >= 0.5f - 1e-6f)
            cut.push_back(t);
    for (const auto& t : sheet(4))
        if (t[0].x <= 0.5f + 1e-6f && t[1].x <= 0.5f + 1e-6f && t[2].x <= 0.5f + 1e-6f)
            cut.push_back(t);
    EXPECT_EQ(checkEdges(cut, sheet(8), 1e-3).cracks, 12u)
        << "eight fine and four coarse edges along x = 1/2";
}

TEST(CheckEdges, letsASimplifiedBorderMoveByTheTolerance)
{
    Triangles cut = sheet(4);
    EXPECT_EQ(checkEdges(cut, sheet(8), 1e-6).cracks, 0u) << "the border is straight";
    for (auto& t : cut)
        for (Float3& p : t)
            if (p.x == 0)
                p.x = -0.01f;
    EXPECT_EQ(checkEdges(cut, sheet(8), 0.011).cracks, 0u);
    const EdgeReport moved = checkEdges(cut, sheet(8), 0.009);
    EXPECT_GT(moved.cracks, 0u);
    EXPECT_NEAR(moved.worst_distance, 0.01, 1e-6);
}

TEST(SignedVolume6, isOneForTheUnitCorner)
{
    EXPECT_NEAR(signedVolume6(tetrahedron()), 1, 1e-12);
}

} // namespace
} // namespace hearth::reference
