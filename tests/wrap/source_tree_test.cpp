// Tests searches over the triangles of a source: nearest triangles against a search through all of them, and
// triangles that bodies may touch against bodies that are known to touch.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/wrap/source_tree.h"
#include "cook/wrap/wrap_mesh.h"
#include "tests/support/shapes.h"
#include "tests/support/surfaces/surface_distance.h"
#include "tests/wrap/wrap_oracle.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace
{

using namespace hearth;
using clusters::Corners3;
using wrap::ConvexBody;

class Random
{
public:
    double next() { return std::uniform_real_distribution<double>(-1, 1)(engine_); }
    Double3 nextPoint() { return {next(), next(), next()}; }

    /// Return a point of the convex hull of corners.
    Double3 nextPointIn(std::span<const Double3> corners)
    {
        Double3 sum;
        double weights = 0;
        for (const Double3 corner : corners)
        {
            const double weight = 1e-3 + std::abs(next());
            sum = sum + corner * weight;
            weights += weight;
        }
        return sum * (1 / weights);
    }

private:
    std::mt19937 engine_{1};
};

Box3 boxAround(const Corners3& triangle)
{
    Box3 box;
    for (const Double3 corner : triangle)
        box.add(narrow(corner));
    // a float may be off by the last of 24 bits
    const Float3 rounding = max(box.max, box.min * -1.0f) * 0x1p-23f;
    return {box.min - rounding, box.max + rounding};
}

/// Corners of a tetrahedron or a triangle, which may be flat, or far away from 0.
std::vector<Double3> makeCorners(Random& random, int i)
{
    std::vector<Double3> corners;
    for (int k = 0; k < 3 + i % 2; ++k)
        corners.push_back(random.nextPoint());
    if (i % 3 == 0)
        for (Double3& corner : corners)
            corner.z *= i % 9 == 0 ? 0 : 1e-9;
    if (i % 5 == 0)
        for (Double3& corner : corners)
            corner = corner + Double3{1e6, -3e6, 2e6};
    return corners;
}

TEST(ConvexBody, mayTouchWhatItTouches)
{
    Random random;
    for (int i = 0; i < 30000; ++i)
    {
        const std::vector<Double3> corners = makeCorners(random, i);
        // a triangle through a point of the body, smaller or larger
        const Double3 inside = random.nextPointIn(corners);
        const double size = std::pow(10, 3 * random.next());
        Corners3 triangle{random.nextPoint() * size, random.nextPoint() * size, {}};
        triangle[2] = (triangle[0] + triangle[1]) * -1;
        for (Double3& corner : triangle)
            corner = inside + corner;
        // three corners are a triangle, which rounding may have moved it off by
        if (corners.size() == 3)
            triangle = {inside, corners[0], inside + random.nextPoint()};
        const ConvexBody body(corners);
        EXPECT_TRUE(body.mayTouch(triangle)) << i;
        EXPECT_TRUE(body.mayTouch(boxAround(triangle))) << i;
    }
}

TEST(ConvexBody, mayTouchWhatSharesACorner)
{
    Random random;
    for (int i = 0; i < 30000; ++i)
    {
        std::vector<Double3> corners = makeCorners(random, i);
        for (Double3& corner : corners)
            corner = widen(narrow(corner));
        const Double3 shared = corners[static_cast<size_t>(i) % corners.size()];
        const Corners3 triangle{random.nextPoint() + shared, shared, random.nextPoint() + shared};
        const ConvexBody body(corners);
        EXPECT_TRUE(body.mayTouch(triangle)) << i;
        EXPECT_TRUE(body.mayTouch(Box3{narrow(shared), narrow(shared)})) << i;
    }
}

TEST(ConvexBody, doesNotTouchWhatOneOfItsFacesSeparates)
{
    Random random;
    for (int i = 0; i < 1000; ++i)
    {
        std::vector<Double3> corners;
        for (int k = 0; k < 4; ++k)
            corners.push_back(random.nextPoint());
        const Double3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (length(normal) < 0.01)
            continue;
        const double behind = dot(normal, corners[3] - corners[0]);
        if (std::abs(behind) < 0.01)
            continue;
        const Double3 out = normal * ((behind > 0 ? -1e-3 : 1e-3) / length(normal));
        const ConvexBody body(corners);
        // the face, a thousandth in front of itself: its box overlaps the body's
        EXPECT_FALSE(body.mayTouch(Corners3{corners[0] + out, corners[1] + out, corners[2] + out}));
        const Float3 point = narrow((corners[0] + corners[1] + corners[2]) * (1 / 3.) + out);
        EXPECT_FALSE(body.mayTouch(Box3{point, point}));
    }
}

/// Search a tree whose triangles have many boxes each, or one.
void expectNearest(const wrap::Surface& surface, double max_edge_m)
{
    const wrap::SourceTree tree(surface, max_edge_m);
    const SurfaceDistance exact(surface.positions, surface.indices);
    Random random;
    uint32_t hint = 0;
    for (int i = 0; i < 300; ++i)
    {
        const Double3 point = random.nextPoint() * 1.5;
        const double distance = exact.to(narrow(point));
        const wrap::SourceTree::Nearest nearest = tree.findNearest(point, hint);
        hint = nearest.triangle;
        EXPECT_NEAR(std::sqrt(nearest.distance2), distance, 1e-6);
        EXPECT_NEAR(length(nearest.offset), distance, 1e-6);
        EXPECT_LT(exact.to(narrow(point - nearest.offset)), 1e-6) << "it is no point of the surface";
        EXPECT_TRUE(tree.isWithin(point, nearest.distance2 * (1 + 1e-9)));
        EXPECT_FALSE(tree.isWithin(point, nearest.distance2 * (1 - 1e-9)));
    }
}

TEST(SourceTree, findsTheNearestTriangle)
{
    expectNearest(wrap::makeSurface(shapes::rock(12, 0.3f)), 1);
    for (const double max_edge_m : {0.05, 100.})
        expectNearest(wrap::makeSurface(shapes::tangle(30, 60)), max_edge_m);
}

TEST(SourceTree, findsTrianglesThatAreTouched)
{
    const wrap::Surface source = wrap::makeSurface(shapes::tangle(30, 60));
    const wrap::Surface probes = wrap::makeSurface(shapes::soup(300, 7));
    wrap::Surface both = source;
    both.positions.insert(both.positions.end(), probes.positions.begin(), probes.positions.end());
    for (const uint32_t index : probes.indices)
        both.indices.push_back(static_cast<uint32_t>(source.positions.size()) + index);
    std::set<uint32_t> found;
    for (const auto& [a, b] : test::findCrossings({both.positions, both.indices}))
        if (a < source.triangleCount() && b >= source.triangleCount())
            found.insert(b - static_cast<uint32_t>(source.triangleCount()));
    const std::vector<uint32_t> touched(found.begin(), found.end());
    EXPECT_GT(touched.size(), 10u);
    EXPECT_LT(touched.size(), probes.triangleCount() - 10);
    for (const double max_edge_m : {0.05, 100.})
    {
        const wrap::SourceTree tree(source, max_edge_m);
        EXPECT_EQ(wrap::findTouching(probes, tree), touched);
    }
}

} // namespace
