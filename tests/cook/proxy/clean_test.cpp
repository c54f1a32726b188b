// Tests that any triangles become a manifold of the same points, whose shells face outwards.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/clean/clean.h"
#include "formats/base/double3.h"
#include "formats/base/index.h"
#include "tests/cook/proxy/surfaces.h"
#include "tests/support/shapes.h"
#include "tests/support/surfaces/surface_distance.h"

#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace hearth::test
{

namespace
{

using proxy::CleanSettings;
using proxy::CleanStatistics;
using proxy::Surface;

double doubledArea(const Surface& surface)
{
    double area = 0;
    for (size_t t = 0; t < surface.triangleCount(); ++t)
    {
        const auto [a, b, c] = surface.corners(t);
        area += length(cross(widen(b) - widen(a), widen(c) - widen(a)));
    }
    return area;
}

/// Clean without filling holes, and expect a manifold of the same points.
CleanStatistics expectSamePoints(Surface& surface)
{
    const Surface before = surface;
    const CleanStatistics statistics = cleanSurface(surface, {.hole_length = 0, .thinness = 0});
    EXPECT_EQ(findDefect(surface), "");
    constexpr size_t kPoints = 2000;
    const double tolerance = 1e-6 * double{findDiagonal(before)};
    EXPECT_LE(largestDistance(before.positions, before.indices, kPoints,
                              SurfaceDistance(surface.positions, surface.indices)),
              tolerance);
    EXPECT_LE(largestDistance(surface.positions, surface.indices, kPoints,
                              SurfaceDistance(before.positions, before.indices)),
              tolerance);
    return statistics;
}

TEST(CleanSurface, leavesAManifoldAsItIs)
{
    for (const Surface& before : {makeBox({0, 0, 0}, {1, 2, 3}), makeTorus(2, 0.5f, 24),
                                  toSurface(shapes::rock(8, 0.3f)), toSurface(shapes::terrain(12))})
    {
        Surface after = before;
        const CleanStatistics statistics = cleanSurface(after);
        EXPECT_EQ(findDefect(after), "");
        EXPECT_EQ(after.triangleCount(), before.triangleCount());
        EXPECT_EQ(after.positions.size(), before.positions.size());
        EXPECT_EQ(statistics.orientation.flipped_triangles, 0u);
        EXPECT_EQ(statistics.manifold.split_edges, 0u);
        EXPECT_EQ(statistics.manifold.split_vertices, 0u);
        EXPECT_EQ(statistics.manifold.added_vertices, 0u);
        EXPECT_EQ(statistics.holes.filled, 0u);
    }
}

TEST(CleanSurface, boxesThatShareAnEdgeStayTwoClosedBoxes)
{
    Surface boxes = makeBox({0, 0, 0}, {1, 1, 1});
    append(boxes, makeBox({1, 1, 0}, {2, 2, 1}));
    weldByPosition(boxes);
    ASSERT_EQ(boxes.positions.size(), 14u);
    const CleanStatistics statistics = expectSamePoints(boxes);
    EXPECT_EQ(statistics.manifold.split_edges, 1u);
    EXPECT_EQ(statistics.manifold.split_vertices, 2u);
    EXPECT_EQ(countBoundaryEdges(boxes), 0u);
    EXPECT_EQ(eulerCharacteristic(boxes), 4) << "two spheres";
    EXPECT_NEAR(signedVolume(boxes), 2, 1e-6);
}

TEST(CleanSurface, boxesThatShareAVertexStayTwoClosedBoxes)
{
    Surface boxes = makeBox({0, 0, 0}, {1, 1, 1});
    append(boxes, makeBox({1, 1, 1}, {2, 2, 2}));
    weldByPosition(boxes);
    const CleanStatistics statistics = expectSamePoints(boxes);
    EXPECT_EQ(statistics.manifold.split_vertices, 1u);
    EXPECT_EQ(eulerCharacteristic(boxes), 4);
}

TEST(CleanSurface, aWallIsTakenOffTheFloor)
{
    for (const bool floor_faces_down : {false, true})
        for (const bool wall_is_turned : {false, true})
        {
            Surface house;
            house.positions = {{0, 0, 0},  {1, 0, 0},  {2, 0, 0}, {0, 0, -1},
                               {1, 0, -1}, {2, 0, -1}, {1, 1, 0}, {1, 1, -1}};
            house.indices = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 1, 4, 7, 1, 7, 6};
            house.materials.assign(6, 0);
            for (size_t t = 0; t < 4 && floor_faces_down; ++t)
                turn(house, t);
            for (size_t t = 4; t < 6 && wall_is_turned; ++t)
                turn(house, t);
            const CleanStatistics statistics = expectSamePoints(house);
            EXPECT_EQ(statistics.manifold.split_edges, 1u);
            EXPECT_EQ(statistics.manifold.split_vertices, 2u);
            EXPECT_EQ(statistics.manifold.added_vertices, 0u);
            EXPECT_EQ(countBoundaryEdges(house), 10u) << "around the floor and around the wall";
        }
}

TEST(CleanSurface, aMoebiusStripIsCutAcross)
{
    Surface strip = toSurface(shapes::moebius(24, 2));
    const CleanStatistics statistics = expectSamePoints(strip);
    EXPECT_GT(statistics.orientation.twisted_edges, 0u);
    EXPECT_GT(countBoundaryEdges(strip), 0u);
}

TEST(CleanSurface, removesDoubledTriangles)
{
    Surface box = makeBox({0, 0, 0}, {1, 1, 1});
    Surface inside_out = box;
    for (size_t t = 0; t < inside_out.triangleCount(); ++t)
        turn(inside_out, t);
    append(box, inside_out);
    weldByPosition(box);
    const CleanStatistics statistics = expectSamePoints(box);
    EXPECT_EQ(statistics.thin.duplicate, 12u);
    EXPECT_EQ(box.triangleCount(), 12u);
    EXPECT_NEAR(signedVolume(box), 1, 1e-6);
}

TEST(CleanSurface, removesNeedles)
{
    // a corner lies beside the middle of the longest edge: the needle's edge is flipped
    Surface strip;
    strip.positions = {{0, 0, 0}, {1, 0, 0}, {0.5f, 1e-5f, 0}, {0.5f, 1, 0}, {0.5f, -1, 0}};
    strip.indices = {0, 1, 2, 0, 2, 3, 2, 1, 3, 1, 0, 4};
    strip.materials = {1, 2, 2, 2};
    const CleanStatistics statistics = cleanSurface(strip);
    EXPECT_EQ(findDefect(strip), "");
    EXPECT_EQ(statistics.thin.flipped, 1u);
    EXPECT_EQ(strip.triangleCount(), 4u);
    for (const uint32_t material : strip.materials)
        EXPECT_NE(material, kInvalidIndex);
}

/// Triangles of a small set of vertices in general position: at edges and vertices meet as many as chance
/// wants.
Surface tangle(uint32_t vertices, uint32_t triangles, uint32_t seed)
{
    std::mt19937 random(seed);
    Surface surface;
    for (uint32_t v = 0; v < vertices; ++v)
    {
        const auto coordinate = [&] { return static_cast<float>(random() % 1024) / 64; };
        surface.positions.push_back({coordinate(), coordinate(), coordinate()});
    }
    while (surface.triangleCount() < triangles)
    {
        const uint32_t a = random() % vertices, b = random() % vertices, c = random() % vertices;
        if (a != b && b != c && c != a)
            surface.add({a, b, c}, 0);
    }
    weldByPosition(surface);
    return surface;
}

TEST(CleanSurface, anyTrianglesBecomeAManifoldOfTheSamePoints)
{
    uint32_t split = 0, added = 0;
    for (uint32_t seed = 0; seed < 60; ++seed)
    {
        Surface surface = tangle(5 + seed % 9, 4 + seed, seed);
        const CleanStatistics statistics = expectSamePoints(surface);
        split += statistics.manifold.split_edges;
        added += statistics.manifold.added_vertices;
        EXPECT_EQ(std::accumulate(surface.materials.begin(), surface.materials.end(), 0u), 0u);
        if (HasFailure())
            FAIL() << "seed " << seed;
    }
    EXPECT_GT(split, 100u);
    EXPECT_GT(added, 10u) << "edges with both ends in common were not tested";
}

TEST(CleanSurface, anyTrianglesBecomeAManifoldWhoseHolesAreFilled)
{
    uint32_t filled = 0;
    for (uint32_t seed = 0; seed < 60; ++seed)
    {
        std::mt19937 random(seed);
        Surface surface = toSurface(shapes::rock(6, 0.4f, seed));
        Surface holey;
        holey.positions = surface.positions;
        for (size_t t = 0; t < surface.triangleCount(); ++t)
            if (random() % 100 > seed)
                holey.add({surface.indices[3 * t], surface.indices[3 * t + 1], surface.indices[3 * t + 2]},
                          7);
        filled += cleanSurface(holey, {.hole_length = 1}).holes.filled;
        EXPECT_EQ(findDefect(holey), "") << "seed " << seed;
        for (const uint32_t material : holey.materials)
            EXPECT_EQ(material, 7u);
    }
    EXPECT_GT(filled, 300u);
}

TEST(CleanSurface, isClosedAgainWhereTrianglesAreMissing)
{
    Surface rock = toSurface(shapes::rock(8, 0.2f));
    const double area = doubledArea(rock);
    for (const size_t missing : {700u, 300u, 5u})
    {
        rock.indices.erase(rock.indices.begin() + static_cast<ptrdiff_t>(3 * missing),
                           rock.indices.begin() + static_cast<ptrdiff_t>(3 * missing + 3));
        rock.materials.pop_back();
    }
    ASSERT_EQ(countBoundaryEdges(rock), 9u);
    Surface open = rock;
    EXPECT_EQ(cleanSurface(open, {.hole_length = 0.001}).holes.open, 3u) << "too long to be filled";
    const CleanStatistics statistics = cleanSurface(rock, {.hole_length = 0.5});
    EXPECT_EQ(findDefect(rock), "");
    EXPECT_EQ(statistics.holes.filled, 3u);
    EXPECT_EQ(countBoundaryEdges(rock), 0u);
    EXPECT_NEAR(doubledArea(rock), area, 1e-4 * area);
}

TEST(CleanSurface, aSheetIsNoHole)
{
    Surface sheet = toSurface(shapes::grid(4));
    const CleanStatistics statistics = cleanSurface(sheet, {.hole_length = 16});
    EXPECT_EQ(statistics.holes.filled, 0u);
    EXPECT_EQ(statistics.holes.open, 1u);
}

TEST(CleanSurface, trianglesThatWereTurnedAtRandomFaceOutwards)
{
    for (uint32_t seed = 1; seed < 6; ++seed)
    {
        Surface torus = makeTorus(2, 0.7f, 20);
        const double volume = signedVolume(torus);
        std::mt19937 random(seed);
        for (size_t t = 0; t < torus.triangleCount(); ++t)
            if (random() % 6 < seed)
                turn(torus, t);
        const CleanStatistics statistics = expectSamePoints(torus);
        EXPECT_EQ(countBoundaryEdges(torus), 0u);
        EXPECT_EQ(eulerCharacteristic(torus), 0);
        EXPECT_NEAR(signedVolume(torus), volume, 1e-4 * volume);
        EXPECT_GT(statistics.orientation.flipped_triangles, 0u);
    }
}

TEST(CleanSurface, aShellThatFacesInwardsIsTurned)
{
    Surface box = makeBox({-1, -1, -1}, {1, 1, 1});
    for (size_t t = 0; t < box.triangleCount(); ++t)
        turn(box, t);
    const CleanStatistics statistics = expectSamePoints(box);
    EXPECT_EQ(statistics.orientation.flipped_shells, 1u);
    EXPECT_NEAR(signedVolume(box), 8, 1e-5);
}

TEST(CleanSurface, aCavityKeepsItsSide)
{
    Surface shell = makeBox({-2, -2, -2}, {2, 2, 2});
    Surface cavity = makeBox({-1, -1, -1}, {1, 1, 1});
    for (size_t t = 0; t < cavity.triangleCount(); ++t)
        turn(cavity, t);
    append(shell, cavity);
    const CleanStatistics statistics = expectSamePoints(shell);
    EXPECT_EQ(statistics.orientation.flipped_shells, 0u) << "rays do not tell: no side is outside";
    EXPECT_NEAR(signedVolume(shell), 64 - 8, 1e-4);
}

TEST(CleanSurface, anOpenSheetKeepsItsSide)
{
    for (const bool is_turned : {false, true})
    {
        Surface sheet = toSurface(shapes::terrain(8));
        if (is_turned)
            for (size_t t = 0; t < sheet.triangleCount(); ++t)
                turn(sheet, t);
        const CleanStatistics statistics = expectSamePoints(sheet);
        EXPECT_EQ(statistics.orientation.flipped_triangles, 0u);
    }
}

TEST(CleanSurface, isTheSameWheneverItIsCleaned)
{
    Surface once = tangle(12, 70, 3), again = once;
    cleanSurface(once);
    cleanSurface(again);
    EXPECT_EQ(once.indices, again.indices);
    EXPECT_EQ(once.materials, again.materials);
}

TEST(CleanSurface, ofNothingIsNothing)
{
    Surface nothing;
    const CleanStatistics statistics = cleanSurface(nothing);
    EXPECT_EQ(nothing.triangleCount(), 0u);
    EXPECT_EQ(statistics.orientation.shells, 0u);
}

} // namespace

} // namespace hearth::test
