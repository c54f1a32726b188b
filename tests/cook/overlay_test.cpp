// The distance along normals against points that are looked at one by one.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/overlay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{

using namespace hearth;
using namespace hearth::clusters;

/// A square of n x n cells with hills, the whole turned in space; nodes are moved within the square by `shift`.
struct Sheet
{
    uint32_t n;
    std::vector<uint32_t> corners;
    std::vector<Float3> places;
    std::vector<uint8_t> open;
};

Float3 turned(Float3 p)
{
    const float c = 0.8f, s = 0.6f;
    const Float3 q{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    return {q.x, c * q.y - s * q.z, s * q.y + c * q.z};
}

Sheet sheet(uint32_t n, float roughness, float shift, std::mt19937& random)
{
    std::uniform_real_distribution<float> unit(-1, 1);
    Sheet sheet{n, {}, {}, {}};
    for (uint32_t y = 0; y <= n; ++y)
        for (uint32_t x = 0; x <= n; ++x)
        {
            const bool edge = x == 0 || y == 0 || x == n || y == n;
            const float move = edge ? 0.0f : shift / static_cast<float>(n);
            const Float3 p{static_cast<float>(x) / static_cast<float>(n) - 0.5f + move * unit(random),
                           static_cast<float>(y) / static_cast<float>(n) - 0.5f + move * unit(random),
                           edge ? 0.0f : roughness * unit(random)};
            sheet.places.push_back(turned(p));
            sheet.open.push_back(edge ? 1 : 0);
        }
    for (uint32_t y = 0; y < n; ++y)
        for (uint32_t x = 0; x < n; ++x)
        {
            const uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 2, d = a + n + 1;
            sheet.corners.insert(sheet.corners.end(), {a, b, c, a, c, d});
        }
    return sheet;
}

double distanceToSegment(Float3 p, Float3 a, Float3 b)
{
    const Float3 ab = b - a;
    const float t = std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0f, 1.0f);
    return length(p - (a + ab * t));
}

double distanceToTriangle(Float3 p, const Corners& t)
{
    const Float3 n = cross(t[1] - t[0], t[2] - t[0]);
    bool inside = true;
    double nearest = 1e30;
    for (size_t k = 0; k < 3; ++k)
    {
        const Float3 a = t[k], b = t[(k + 1) % 3];
        inside &= dot(cross(b - a, p - a), n) >= 0;
        nearest = std::min(nearest, distanceToSegment(p, a, b));
    }
    return inside ? std::abs(double{dot(p - t[0], n)}) / length(n) : nearest;
}

/// The largest distance to the surface of points spread over the triangle.
double sampledDistance(const Corners& triangle, const Surface& surface)
{
    constexpr int kSteps = 24;
    double farthest = 0;
    for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; i + j <= kSteps; ++j)
        {
            const float u = static_cast<float>(i) / kSteps, v = static_cast<float>(j) / kSteps;
            const Float3 p = triangle[0] * (1 - u - v) + triangle[1] * u + triangle[2] * v;
            double nearest = 1e30;
            for (size_t f = 0; f < surface.facetCount(); ++f)
                nearest = std::min(nearest, distanceToTriangle(p, surface.cornersOf(f)));
            farthest = std::max(farthest, nearest);
        }
    return farthest;
}

TEST(Overlay, boundsTheDistanceOfEveryPoint)
{
    std::mt19937 random(5);
    size_t bounded = 0, asked = 0;
    double bounds = 0, distances = 0;
    for (int round = 0; round < 12; ++round)
    {
        const float roughness = 0.002f * static_cast<float>(1 + round % 4 * 8);
        const Sheet of_many = sheet(9, roughness, 0.35f, random);
        const Sheet of_few = sheet(4, roughness, 0.35f, random);
        const Surface fine(of_many.corners, of_many.places), coarse(of_few.corners, of_few.places);
        for (const bool upwards : {false, true})
        {
            const Sheet& seen = upwards ? of_few : of_many;
            const Surface& surface = upwards ? coarse : fine;
            const Surface& from = upwards ? fine : coarse;
            Overlay overlay(surface, seen.open, std::vector<float>(seen.places.size(), 0.25f));
            for (size_t f = 0; f < from.facetCount(); ++f)
            {
                const Corners triangle = from.cornersOf(f);
                const Float3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0f;
                overlay.clear();
                for (uint32_t p = 0; p < seen.places.size(); ++p)
                    if (length(seen.places[p] - middle) < 0.45f)
                        overlay.addCenter(p);
                const float bound = overlay.heightOver(triangle);
                ++asked;
                if (!std::isfinite(bound))
                    continue;
                ++bounded;
                const double there = sampledDistance(triangle, surface);
                EXPECT_GE(bound - 0.25f, there) << "round " << round << ", triangle " << f;
                bounds += bound - 0.25;
                distances += there;
            }
        }
    }
    EXPECT_GT(bounded * 10, asked * 9) << "the sheets lie over each other nearly everywhere";
    EXPECT_LT(bounds, 1.5 * distances);
}

TEST(Overlay, seesANeedleInTheMiddleOfATriangle)
{
    // three rings of three positions, the outermost open, and a tip over the innermost, which is finer than rounding
    constexpr float kHeight = 0.5f;
    std::vector<Float3> places;
    std::vector<uint32_t> corners;
    for (const float radius : {3.0f, 5e-3f, 2e-6f})
        for (const Float3 p : {Float3{-0.8f, -0.6f, 0}, Float3{0.8f, -0.6f, 0}, Float3{0, 1, 0}})
            places.push_back(p * radius);
    places.push_back({0, 0, kHeight});
    for (uint32_t k = 0; k < 3; ++k)
    {
        const uint32_t next = (k + 1) % 3;
        for (const uint32_t ring : {0u, 3u})
            corners.insert(corners.end(),
                           {ring + k, ring + next, ring + 3 + next, ring + k, ring + 3 + next, ring + 3 + k});
        corners.insert(corners.end(), {6 + k, 6 + next, 9});
    }
    const Surface surface(corners, places);
    const std::vector<uint8_t> open{1, 1, 1, 0, 0, 0, 0, 0, 0, 0};
    Overlay overlay(surface, open, std::vector<float>(places.size(), 0));
    overlay.clear();
    for (uint32_t p = 3; p < places.size(); ++p)
        overlay.addCenter(p);
    const float bound =
        overlay.heightOver({Float3{-0.4f, -0.3f, 0}, Float3{0.4f, -0.3f, 0}, Float3{0, 0.5f, 0}});
    ASSERT_TRUE(std::isfinite(bound));
    EXPECT_GE(bound, kHeight);
}

TEST(Overlay, isWithoutBoundWhereThePatchEnds)
{
    std::mt19937 random(7);
    const Sheet whole = sheet(6, 0.01f, 0.2f, random);
    const Surface surface(whole.corners, whole.places);
    Overlay overlay(surface, whole.open, std::vector<float>(whole.places.size(), 0));
    const Corners within{turned({-0.1f, -0.1f, 0}), turned({0.1f, -0.1f, 0}), turned({0, 0.1f, 0})};
    const Corners beyond{turned({0.3f, -0.1f, 0}), turned({0.7f, -0.1f, 0}), turned({0.4f, 0.1f, 0})};
    const auto ofAll = [&](const Corners& triangle)
    {
        overlay.clear();
        for (uint32_t p = 0; p < whole.places.size(); ++p)
            overlay.addCenter(p);
        return overlay.heightOver(triangle);
    };
    EXPECT_TRUE(std::isfinite(ofAll(within)));
    EXPECT_FALSE(std::isfinite(ofAll(beyond))) << "it leaves the sheet";
    EXPECT_FALSE(std::isfinite(ofAll({within[0], within[2], within[1]})))
        << "the sheet runs the other way round";
    overlay.clear();
    overlay.addCenter(3 * 7 + 3);
    const Corners wide{turned({-0.4f, -0.4f, 0}), turned({0.4f, -0.4f, 0}), turned({0, 0.4f, 0})};
    EXPECT_FALSE(std::isfinite(overlay.heightOver(wide)))
        << "facets beside the center's are not in the patch";
}

} // namespace
