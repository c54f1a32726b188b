// Compares the closed form of visibility beside polygons with sums over directions, and with formulas of
// infinite walls.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/polygon_visibility.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace hearth::reference
{

namespace
{

constexpr double kPi = std::numbers::pi;
constexpr double kFar = 1e5; ///< practically infinite beside points at distances about 1

/// True if the ray from the origin along `direction` hits the convex polygon.
bool isHit(const Polygon& polygon, Double3 direction)
{
    int above = 0, below = 0;
    for (size_t i = 0; i < polygon.size(); ++i)
    {
        const double side = dot(cross(polygon[i], polygon[(i + 1) % polygon.size()]), direction);
        (side > 0 ? above : below) += 1;
    }
    const Double3 plane = cross(polygon[1] - polygon[0], polygon[2] - polygon[0]);
    return (above == 0 || below == 0) && dot(plane, polygon[0]) / dot(plane, direction) > 0;
}

/// Sum over directions that divide the hemisphere evenly.
HemisphereMoments sumOverDirections(Double3 point, Double3 normal, const std::vector<Polygon>& polygons)
{
    constexpr int kRings = 300, kSectors = 1200;
    const Double3 x =
        normalize(cross(normal, std::abs(normal.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0}));
    const Double3 y = cross(normal, x);
    std::vector<Polygon> moved = polygons;
    for (Polygon& polygon : moved)
        for (Double3& corner : polygon)
            corner = corner - point;
    const double solid = 2 * kPi / (kRings * kSectors);
    HemisphereMoments sum;
    for (int ring = 0; ring < kRings; ++ring)
        for (int sector = 0; sector < kSectors; ++sector)
        {
            const double z = (ring + 0.5) / kRings, r = std::sqrt(1 - z * z);
            const double azimuth = 2 * kPi * (sector + 0.5) / kSectors;
            const Double3 direction = x * (r * std::cos(azimuth)) + y * (r * std::sin(azimuth)) + normal * z;
            bool blocked = false;
            for (const Polygon& polygon : moved)
                blocked = blocked || isHit(polygon, direction);
            if (blocked)
                continue;
            sum.m0 += solid;
            sum.m1 += direction * solid;
        }
    return sum;
}

} // namespace

TEST(PolygonVisibility, equalsSumsOverDirections)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto direction = [&] {
        return normalize(Double3{uniform(random), uniform(random), uniform(random)});
    };
    for (int i = 0; i < 6; ++i)
    {
        // a triangle and a quadrangle on two sides of the normal, both through the horizon
        const Double3 normal = direction(), side = normalize(cross(normal, direction()));
        const Double3 across = cross(normal, side), point{uniform(random), uniform(random), uniform(random)};
        const std::vector<Polygon> polygons{
            {point + side - across + normal * uniform(random), point + side * 0.7 + across,
             point + side + normal * 1.5},
            {point - side * 0.8 - across - normal * 0.3, point - side * 0.8 + across - normal * 0.3,
             point - side * 0.5 + across * 0.7 + normal, point - side * 0.5 - across * 0.7 + normal}};
        const HemisphereMoments exact = visibleBesidePolygons(point, normal, polygons);
        const HemisphereMoments sum = sumOverDirections(point, normal, polygons);
        EXPECT_NEAR(exact.m0, sum.m0, 2e-3);
        EXPECT_LT(length(exact.m1 - sum.m1), 2e-3);
        EXPECT_LT(exact.m0, 6) << "something is hidden";
    }
}

TEST(PolygonVisibility, isThatOfInfiniteWallsAndGrooves)
{
    const Double3 up{0, 0, 1};
    const std::vector<Polygon> crease{{{0, -kFar, 0}, {0, kFar, 0}, {0, kFar, kFar}, {0, -kFar, kFar}}};
    EXPECT_NEAR(dot(visibleBesidePolygons({1e-3, 0, 0}, up, crease).m1, up) / kPi, 0.5, 1e-6);
    // a wall of height h at distance x
    const double x = 0.7, h = 1.3, phi = std::atan2(h, x);
    const std::vector<Polygon> wall{{{0, -kFar, 0}, {0, kFar, 0}, {0, kFar, h}, {0, -kFar, h}}};
    const HemisphereMoments beside = visibleBesidePolygons({x, 0, 0}, up, wall);
    EXPECT_NEAR(beside.m0, 2 * kPi - 2 * phi, 1e-4);
    EXPECT_NEAR(beside.m1.x, kPi / 2 * std::sin(phi), 1e-4);
    EXPECT_NEAR(beside.m1.z, kPi / 2 * (1 + std::cos(phi)), 1e-4);
    // one side of a groove whose other side is 1 long: it sees from its horizon to that side's end
    for (const double opening : {0.5, kPi / 3, 2 * kPi / 3})
    {
        const Double3 end{std::cos(opening), 0, std::sin(opening)}, along{0, kFar, 0};
        const std::vector<Polygon> side{{along, -along, end - along, end + along}};
        const double seen = std::atan2(end.z, end.x - 0.4);
        EXPECT_NEAR(dot(visibleBesidePolygons({0.4, 0, 0}, up, side).m1, up) / kPi, (1 - std::cos(seen)) / 2,
                    1e-6);
    }
}

} // namespace hearth::reference
