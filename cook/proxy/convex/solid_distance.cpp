// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/convex/solid_distance.h"

#include "cook/proxy/surface/half_edges.h"
#include "formats/base/disjoint_sets.h"
#include "formats/base/index.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace hearth::proxy
{

namespace
{

std::vector<Float3> collectClosedCorners(const Surface& surface, const std::vector<bool>& is_closed)
{
    std::vector<Float3> corners;
    for (size_t t = 0; t < surface.triangleCount(); ++t)
        if (is_closed[t])
            for (const Float3 corner : surface.corners(t))
                corners.push_back(corner);
    return corners;
}

// A bound that is this many times the greatest distance found is good enough.
constexpr double kEnoughTimes = 1.1;

/// Part of a triangle, with an upper bound of the distance of its points.
struct PartOfTriangle
{
    std::array<Float3, 3> corners;
    uint32_t near; ///< triangle of the surface
    double upper;

    bool operator<(const PartOfTriangle& other) const { return upper < other.upper; }
};

} // namespace

Shells findShells(const Surface& surface)
{
    const std::vector<uint32_t> joined = joinHalfEdges(surface);
    DisjointSets sets(surface.triangleCount());
    for (uint32_t h = 0; h < joined.size(); ++h)
        if (joined[h] != kInvalidIndex)
            sets.unite(h / 3, joined[h] / 3);
    Shells shells{{}, std::vector<bool>(surface.triangleCount(), true)};
    for (uint32_t h = 0; h < joined.size(); ++h)
        if (joined[h] == kInvalidIndex)
            shells.is_closed[sets.find(h / 3)] = false;
    for (uint32_t t = 0; t < surface.triangleCount(); ++t)
    {
        shells.of_triangle.push_back(sets.find(t));
        shells.is_closed[t] = shells.is_closed[sets.find(t)];
    }
    return shells;
}

Solid::Solid(const Surface& surface)
    : surface_(surface),
      shells_(findShells(surface)),
      closest_(surface.view(), surface.triangleCount()),
      closed_shells_(collectClosedCorners(surface, shells_.is_closed))
{
}

bool Solid::isInside(Float3 point) const
{
    // slanted, so that rays seldom run within faces; all must agree that the first shell that they meet is
    // left
    constexpr std::array<Float3, 3> kDirections{
        {{0.8017f, 0.2673f, 0.5345f}, {-0.4082f, 0.8165f, -0.4083f}, {-0.1826f, -0.3651f, 0.9129f}}};
    return std::ranges::all_of(
        kDirections,
        [&](Float3 direction)
        {
            const std::optional<ray_scene::TriangleHit> met = closed_shells_.nearest(point, direction);
            if (!met)
                return false;
            const std::span<const Float3, 3> corners = closed_shells_.triangle(met->triangle);
            return dot(cross(corners[1] - corners[0], corners[2] - corners[0]), direction) > 0;
        });
}

double Solid::boundDistance(std::span<const std::array<Float3, 3>> triangles, double enough,
                            double limit) const
{
    std::priority_queue<PartOfTriangle> parts;
    double greatest = 0; // of points that are known to be outside
    const auto isEnough = [&](double upper)
    { return upper <= std::max(kEnoughTimes * greatest, greatest + enough); };
    const auto add = [&](const std::array<Float3, 3>& corners, uint32_t near)
    {
        const Float3 middle = (corners[0] + corners[1] + corners[2]) * (1.0f / 3);
        const mesh::ClosestPoint::Hit hit =
            closest_.find(middle, {}, std::numeric_limits<double>::infinity(), near);
        const double distance = std::sqrt(hit.distance2);
        double radius = 0, to_nearest2 = 0;
        for (const Float3 corner : corners)
        {
            radius = std::max(radius, double{length(corner - middle)});
            // the distance to one triangle is convex, so it is greatest at a corner
            to_nearest2 = std::max(to_nearest2, closest_.findDistance2(corner, hit.triangle));
        }
        double upper = std::min(distance + radius, std::sqrt(to_nearest2));
        if (!isEnough(upper) && isInside(middle))
            upper = std::max(0.0, radius - distance); // the solid ends no nearer than that
        else if (!isEnough(upper))
            greatest = std::max(greatest, distance);
        parts.push({corners, hit.triangle, upper});
    };
    for (const std::array<Float3, 3>& corners : triangles)
        add(corners, kInvalidIndex);
    while (!parts.empty() && greatest <= limit && !isEnough(parts.top().upper))
    {
        const auto [corners, near, upper] = parts.top();
        const auto [a, b, c] = corners;
        parts.pop();
        const Float3 ab = (a + b) * 0.5f, bc = (b + c) * 0.5f, ca = (c + a) * 0.5f;
        add({a, ab, ca}, near);
        add({ab, b, bc}, near);
        add({ca, bc, c}, near);
        add({ab, bc, ca}, near);
    }
    return parts.empty() ? 0 : parts.top().upper;
}

} // namespace hearth::proxy
