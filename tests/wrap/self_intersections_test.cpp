// Compares the triangles that intersect, as CGAL finds them, with a plain test of all pairs; and the plain
// checks of wraps with surfaces that break them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/wrap/wrap_mesh.h"
#include "tests/support/shapes.h"
#include "tests/wrap/wrap_oracle.h"

#include <gtest/gtest.h>

namespace
{

using namespace hearth;
using test::CheckedSurface;
using test::findCrossings;

constexpr size_t kAllPairs = 1u << 20;

std::vector<std::pair<uint32_t, uint32_t>> findByCgal(const wrap::Surface& surface)
{
    const auto found = wrap::findSelfIntersections(surface, kAllPairs, 60);
    EXPECT_TRUE(found);
    EXPECT_EQ(found->count, found->pairs.size());
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    for (const wrap::TrianglePair& pair : found->pairs)
        pairs.emplace_back(pair.a, pair.b);
    return pairs;
}

void expectSamePairs(const wrap::Surface& surface)
{
    const auto plain = findCrossings({surface.positions, surface.indices});
    EXPECT_EQ(findByCgal(surface), plain);
}

/// Triangles over points of a small lattice: many share corners, edges and planes.
wrap::Surface makeLatticeTangle(uint32_t seed, uint32_t triangles)
{
    wrap::Surface surface;
    for (int i = 0; i < 27; ++i)
        surface.positions.push_back(
            {static_cast<float>(i % 3), static_cast<float>(i / 3 % 3), static_cast<float>(i / 9)});
    uint32_t random = seed;
    const auto next = [&] { return (random = random * 1664525u + 1013904223u) >> 16; };
    while (surface.triangleCount() < triangles)
    {
        const std::array<uint32_t, 3> corners = {next() % 27, next() % 27, next() % 27};
        const Double3 a = widen(surface.positions[corners[0]]);
        if (length(cross(widen(surface.positions[corners[1]]) - a,
                         widen(surface.positions[corners[2]]) - a)) > 0)
            surface.indices.insert(surface.indices.end(), corners.begin(), corners.end());
    }
    return surface;
}

TEST(SelfIntersections, AreThoseOfAllPairs)
{
    for (uint32_t seed = 0; seed < 20; ++seed)
        expectSamePairs(makeLatticeTangle(seed, 60));
    expectSamePairs(wrap::makeSurface(shapes::tangle(40, 80)));
    expectSamePairs(wrap::makeSurface(shapes::foliage(60)));
}

TEST(SelfIntersections, NeighboursOnlyWhereTheyOverlap)
{
    const std::vector<Float3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.25f, 0.5f, 0}};
    const auto count = [&](std::vector<uint32_t> indices) {
        return findByCgal({positions, std::move(indices)}).size();
    };
    EXPECT_EQ(count({0, 1, 2, 2, 1, 3}), 0u) << "two halves of a square";
    EXPECT_EQ(count({0, 1, 2, 0, 1, 4}), 1u) << "folded onto each other at an edge";
    EXPECT_EQ(count({0, 1, 2, 0, 2, 1}), 1u) << "twice the same, once flipped";
    EXPECT_EQ(count({0, 1, 4, 2, 4, 3}), 0u) << "a common corner";
    EXPECT_EQ(count({0, 1, 2, 0, 4, 3}), 1u) << "a common corner, and beyond it";
}

TEST(SelfIntersections, AreNoneInAClosedSurface)
{
    EXPECT_TRUE(findByCgal(wrap::makeSurface(shapes::rock(12, 0))).empty());
}

TEST(SelfIntersections, OnlyTheFirstPairsAreListed)
{
    const wrap::Surface surface = makeLatticeTangle(1, 200);
    const auto all = wrap::findSelfIntersections(surface, kAllPairs, 60);
    const auto some = wrap::findSelfIntersections(surface, 10, 60);
    ASSERT_TRUE(all && some);
    ASSERT_GT(all->count, 2000u);
    EXPECT_EQ(some->count, all->count);
    EXPECT_TRUE(
        std::equal(some->pairs.begin(), some->pairs.end(), all->pairs.begin(), all->pairs.begin() + 10));
}

TEST(SelfIntersections, TimeIsLimited)
{
    EXPECT_FALSE(wrap::findSelfIntersections(makeLatticeTangle(1, 200), 10, 1e-9));
}

/// Octahedron.
wrap::Surface makeClosed()
{
    return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
            {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5}};
}

TEST(WrapOracle, SeesWhatIsBroken)
{
    const wrap::Surface whole = makeClosed();
    const CheckedSurface surface{whole.positions, whole.indices};
    EXPECT_TRUE(test::isWatertight(surface));
    EXPECT_TRUE(findCrossings(surface).empty());
    EXPECT_NEAR(test::windingNumber(surface, {0.1, 0.1, 0.1}), 1, 1e-9);
    EXPECT_NEAR(test::windingNumber(surface, {1, 1, 0.1}), 0, 1e-9);
    EXPECT_NEAR(test::enclosedVolume(surface), 4 / 3., 1e-9);

    EXPECT_FALSE(test::isWatertight({whole.positions, std::span(whole.indices).subspan(3)})) << "a hole";
    std::vector<uint32_t> flipped = whole.indices;
    std::swap(flipped[0], flipped[1]);
    EXPECT_FALSE(test::isWatertight({whole.positions, flipped}));
    std::vector<Float3> pushed = whole.positions;
    pushed[0] = {-0.5f, 0.75f, 0.125f}; // through the opposite side
    EXPECT_FALSE(findCrossings({pushed, whole.indices}).empty());
}

} // namespace
