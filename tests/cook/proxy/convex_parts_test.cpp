// Compares hulls with plain searches, and convex parts with solids whose decomposition is known.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/clean/clean.h"
#include "cook/proxy/convex/decompose.h"
#include "cook/proxy/convex/hull.h"
#include "formats/base/double3.h"
#include "tests/cook/proxy/surfaces.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using proxy::ConvexParts;
using proxy::ConvexSettings;
using proxy::Hull;
using proxy::LatticePoint;
using proxy::Solid;
using proxy::Surface;

/// Sign of the volume of a tetrahedron, exactly: a lattice has at most 20 bits.
int findSide(LatticePoint a, LatticePoint b, LatticePoint c, LatticePoint p)
{
    using Wide = long double; // 64 bits
    const Wide ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
    const Wide vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
    const Wide volume = (uy * vz - uz * vy) * (p.x - a.x) + (uz * vx - ux * vz) * (p.y - a.y) +
                        (ux * vy - uy * vx) * (p.z - a.z);
    return volume > 0 ? 1 : volume < 0 ? -1 : 0;
}

/// Return what is wrong with the hull of points; empty if nothing is.
std::string findHullDefect(const std::vector<LatticePoint>& points, const Hull& hull)
{
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (const auto& t : hull.triangles)
    {
        for (size_t k = 0; k < 3; ++k)
            if (!edges.insert({t[k], t[(k + 1) % 3]}).second)
                return "an edge is passed twice in one direction";
        for (const LatticePoint p : points)
            if (findSide(hull.points[t[0]], hull.points[t[1]], hull.points[t[2]], p) > 0)
                return "a point is outside";
    }
    for (const auto& [a, b] : edges)
        if (!edges.contains({b, a}))
            return "an edge has one triangle";
    if (hull.points.size() - edges.size() / 2 + hull.triangles.size() != 2)
        return "it is no sphere";
    for (const LatticePoint p : hull.points)
        if (std::ranges::find(points, p) == points.end())
            return "a vertex is none of the points";
    return {};
}

bool areFlat(const std::vector<LatticePoint>& points)
{
    for (size_t b = 1; b < points.size(); ++b)
        for (size_t c = 1; c < b; ++c)
            for (const LatticePoint p : points)
                if (findSide(points[0], points[c], points[b], p) != 0)
                    return false;
    return true;
}

std::vector<LatticePoint> makePoints(std::mt19937& random, size_t count, int32_t reach)
{
    std::uniform_int_distribution<int32_t> coordinate(-reach, reach);
    std::vector<LatticePoint> points;
    for (size_t i = 0; i < count; ++i)
        points.push_back({coordinate(random), coordinate(random), coordinate(random)});
    return points;
}

TEST(Hull, holdsItsPointsAndHasNoOtherVertices)
{
    std::mt19937 random(1);
    size_t flat = 0;
    for (int i = 0; i < 400; ++i)
    {
        // small reaches: many points in one plane, in one line, or equal; the largest: the widest products
        const int32_t reach = i % 4 == 0   ? 1
                              : i % 4 == 1 ? 3
                              : i % 4 == 2 ? 40
                                           : proxy::kMaxLatticeCoordinate;
        const std::vector<LatticePoint> points = makePoints(random, 1 + random() % 40, reach);
        const Hull hull = proxy::makeHull(points);
        if (hull.triangles.empty())
        {
            EXPECT_TRUE(areFlat(points)) << "set " << i;
            ++flat;
            continue;
        }
        EXPECT_EQ(findHullDefect(points, hull), "") << "set " << i << ", " << points.size() << " points";
        for (const LatticePoint p : makePoints(random, 20, reach))
        {
            bool is_in_front = false;
            for (const auto& [a, b, c] : hull.triangles)
                is_in_front = is_in_front || findSide(hull.points[a], hull.points[b], hull.points[c], p) > 0;
            EXPECT_EQ(proxy::holds(hull, p), !is_in_front);
        }
    }
    EXPECT_GT(flat, 10u);
}

TEST(Hull, measuresABox)
{
    std::vector<LatticePoint> points;
    for (int32_t x = 0; x <= 4; ++x)
        for (int32_t y = 0; y <= 6; ++y)
            for (int32_t z = 0; z <= 10; ++z)
                points.push_back({x - 100, y, z});
    const Hull hull = proxy::makeHull(points);
    EXPECT_EQ(findHullDefect(points, hull), "");
    EXPECT_DOUBLE_EQ(proxy::findVolume(hull), 240);
    EXPECT_DOUBLE_EQ(proxy::findArea(hull), 2 * (24 + 40 + 60));
}

TEST(Hull, stopsAtItsMostPoints)
{
    std::mt19937 random(2);
    const std::vector<LatticePoint> points = makePoints(random, 2000, 1000);
    const Hull hull = proxy::makeHull(points, 20);
    EXPECT_LE(hull.points.size(), 20u);
    EXPECT_GT(proxy::findVolume(hull), 0.5 * proxy::findVolume(proxy::makeHull(points)));
}

/// Return how far a point is in front of the planes of a part, at most; negative inside.
double heightOver(const ConvexParts& parts, size_t part, Float3 point)
{
    double height = -std::numeric_limits<double>::infinity();
    for (size_t t = part == 0 ? 0 : parts.ends[part - 1]; t < parts.ends[part]; ++t)
    {
        const auto [a, b, c] = parts.surface.corners(t);
        const Double3 normal = cross(widen(b) - widen(a), widen(c) - widen(a));
        height = std::max(height, dot(normal, widen(point) - widen(a)) / length(normal));
    }
    return height;
}

/// Expect parts that are closed, convex, and hold the surface together.
void expectParts(const ConvexParts& parts, const Surface& surface)
{
    EXPECT_EQ(findDefect(parts.surface), "");
    EXPECT_EQ(countBoundaryEdges(parts.surface), 0u);
    ASSERT_FALSE(parts.ends.empty());
    EXPECT_EQ(parts.ends.back(), parts.surface.triangleCount());
    for (size_t part = 0; part < parts.ends.size(); ++part)
    {
        std::set<uint32_t> vertices;
        for (size_t i = part == 0 ? 0 : 3 * size_t{parts.ends[part - 1]}; i < 3 * size_t{parts.ends[part]};
             ++i)
            vertices.insert(parts.surface.indices[i]);
        EXPECT_LE(vertices.size(), proxy::kMaxPartVertices);
        for (const uint32_t vertex : vertices)
            EXPECT_LE(heightOver(parts, part, parts.surface.positions[vertex]), 0) << "part " << part;
    }
    double outside = 0;
    for (const Float3 position : surface.positions)
    {
        double least = std::numeric_limits<double>::infinity();
        for (size_t part = 0; part < parts.ends.size(); ++part)
            least = std::min(least, heightOver(parts, part, position));
        outside = std::max(outside, least);
    }
    EXPECT_LE(outside, parts.surface_distance);
    EXPECT_LE(parts.surface_distance, 2e-5 * double{proxy::findDiagonal(surface)});
}

TEST(ConvexParts, leaveConvexSolidsWhole)
{
    for (const Surface& surface : {makeBox({-1, 2, 0.3f}, {3, 2.5f, 7}), toSurface(shapes::rock(12, 0))})
    {
        const Solid solid(surface);
        const ConvexParts parts = decompose(solid, {});
        expectParts(parts, surface);
        EXPECT_EQ(parts.ends.size(), 1u);
        EXPECT_NEAR(signedVolume(parts.surface), signedVolume(surface), 0.1 * signedVolume(surface));
    }
}

/// Box at a slant with a hook: three boxes that share faces, one solid.
Surface makeHook()
{
    // the outline of a C, extruded
    const std::vector<Float2> outline{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {3, 3}, {3, 4}, {0, 4}};
    const uint32_t quads[3][4] = {{0, 1, 2, 3}, {0, 3, 4, 7}, {7, 4, 5, 6}};
    Surface hook;
    const float c = std::cos(0.4f), s = std::sin(0.4f);
    for (const float z : {0.0f, 1.0f})
        for (const Float2 p : outline)
            hook.positions.push_back({c * p.x - s * p.y, s * p.x + c * p.y, z});
    const auto addQuad = [&](uint32_t p, uint32_t q, uint32_t r, uint32_t t)
    {
        hook.add({p, q, r}, 0);
        hook.add({p, r, t}, 0);
    };
    for (const auto& [p, q, r, t] : quads)
    {
        addQuad(t, r, q, p);
        addQuad(p + 8, q + 8, r + 8, t + 8);
    }
    for (uint32_t i = 0; i < 8; ++i)
        addQuad(i, (i + 1) % 8, (i + 1) % 8 + 8, i + 8);
    return hook;
}

TEST(ConvexParts, cutAlongFaces)
{
    const Surface hook = makeHook();
    ASSERT_EQ(findDefect(hook), "");
    const Solid solid(hook);
    const ConvexParts parts = decompose(solid, {});
    expectParts(parts, hook);
    EXPECT_EQ(parts.ends.size(), 3u);
    EXPECT_NEAR(signedVolume(parts.surface), signedVolume(hook), 1e-3 * signedVolume(hook));
    EXPECT_LT(parts.distance, 0.011 * double{proxy::findDiagonal(hook)});
}

TEST(ConvexParts, followATorus)
{
    const Surface torus = makeTorus(2, 0.5f, 24);
    const Solid solid(torus);
    double volume = std::numeric_limits<double>::infinity();
    for (const uint32_t count : {1u, 4u, 16u})
    {
        const ConvexParts parts = decompose(solid, {.max_parts = count, .error = 0.01});
        expectParts(parts, torus);
        EXPECT_LE(parts.ends.size(), count);
        EXPECT_LT(signedVolume(parts.surface), volume);
        volume = signedVolume(parts.surface);
    }
    EXPECT_LT(volume, 1.25 * signedVolume(torus));
}

TEST(ConvexParts, thickenSheets)
{
    // an open box: five sheets, no solid
    Surface box = makeBox({0, 0, 0}, {2, 2, 2});
    box.indices.resize(30);
    box.materials.resize(10);
    proxy::cleanSurface(box, {.hole_length = 0});
    const Solid solid(box);
    const ConvexParts parts = decompose(solid, {});
    expectParts(parts, box);
    EXPECT_EQ(parts.ends.size(), 5u);
    EXPECT_LT(signedVolume(parts.surface), 0.1);
}

TEST(ConvexParts, haveTheMaterialOfMostOfTheirArea)
{
    Surface boxes = makeBox({0, 0, 0}, {1, 1, 1});
    std::ranges::fill(boxes.materials, 7u);
    boxes.materials[0] = 2;
    append(boxes, makeBox({4, 0, 0}, {5, 1, 1}));
    const Solid solid(boxes);
    const ConvexParts parts = decompose(solid, {});
    ASSERT_EQ(parts.ends.size(), 2u);
    EXPECT_EQ(parts.surface.materials.front(), 7u);
    EXPECT_EQ(parts.surface.materials.back(), 0u);
}

/// Distance of a point from a torus about the z axis; 0 inside.
double distanceOfTorus(Float3 point, double radius, double thickness)
{
    const double ring = std::hypot(double{point.x}, double{point.y}) - radius;
    return std::max(0.0, std::hypot(ring, double{point.z}) - thickness);
}

TEST(ConvexParts, haveABoundOfTheirDistance)
{
    // so fine that it is a torus but for two thousandths
    const Surface torus = makeTorus(2, 0.5f, 80);
    const Solid solid(torus);
    for (const uint32_t count : {1u, 5u})
    {
        const ConvexParts parts = decompose(solid, {.max_parts = count, .error = 0.005});
        double greatest = 0;
        for (size_t t = 0; t < parts.surface.triangleCount(); ++t)
        {
            constexpr int kSteps = 40;
            const auto [a, b, c] = parts.surface.corners(t);
            for (int i = 0; i <= kSteps; ++i)
                for (int j = 0; j <= kSteps - i; ++j)
                {
                    const Float3 point = a + (b - a) * (float(i) / kSteps) + (c - a) * (float(j) / kSteps);
                    greatest = std::max(greatest, distanceOfTorus(point, 2, 0.5));
                }
        }
        EXPECT_GE(parts.distance, greatest - 2e-3);
        EXPECT_LE(parts.distance, 1.1 * greatest + 4e-3) << count << " parts";
    }
}

TEST(ConvexParts, countCavitiesAsOutside)
{
    // a cavity is outside of the solid: the hull of both shells reaches half its width into it
    Surface hollow = makeBox({0, 0, 0}, {4, 4, 4});
    Surface cavity = makeBox({1, 1, 1}, {3, 3, 3});
    for (size_t t = 0; t < cavity.triangleCount(); ++t)
        turn(cavity, t);
    append(hollow, cavity);
    const Solid solid(hollow);
    const std::array<Float3, 3> within{{{0.4f, 0.4f, 0.5f}, {3.6f, 0.4f, 0.5f}, {0.4f, 3.6f, 0.5f}}};
    EXPECT_LT(solid.boundDistance({&within, 1}, 0.01), 0.011);
    const std::array<Float3, 3> through{{{1.5f, 1.5f, 2}, {2.5f, 1.5f, 2}, {1.5f, 2.5f, 2}}};
    EXPECT_NEAR(solid.boundDistance({&through, 1}, 0.01), 1, 0.12);
}

} // namespace

} // namespace hearth::test
