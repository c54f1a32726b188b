// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/polygon_visibility.h"

#include <numbers>

namespace hearth::reference
{

namespace
{

/// Clip a polygon about the origin to the half-space above the horizon.
Polygon clipToHorizon(const Polygon& polygon, Double3 normal)
{
    Polygon clipped;
    for (size_t i = 0; i < polygon.size(); ++i)
    {
        const Double3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double height_a = dot(a, normal), height_b = dot(b, normal);
        if (height_a >= 0)
            clipped.push_back(a);
        if ((height_a >= 0) != (height_b >= 0))
            clipped.push_back(a + (b - a) * (height_a / (height_a - height_b)));
    }
    return clipped;
}

/// Return the moments of the directions of a polygon about the origin.
HemisphereMoments computeMoments(const Polygon& polygon)
{
    Polygon directions;
    Double3 middle;
    for (const Double3 corner : polygon)
    {
        directions.push_back(normalize(corner));
        middle += directions.back();
    }
    HemisphereMoments moments;
    for (size_t i = 0; i < directions.size(); ++i)
    {
        const Double3 a = directions[i], b = directions[(i + 1) % directions.size()], turn = cross(a, b);
        const double sine = length(turn);
        if (sine > 0)
            moments.m1 += turn * (0.5 * std::atan2(sine, dot(a, b)) / sine);
    }
    for (size_t i = 2; i < directions.size(); ++i)
    {
        const Double3 a = directions[0], b = directions[i - 1], c = directions[i];
        moments.m0 += 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
    }
    // the order of the corners gives both their sign
    moments.m0 = std::abs(moments.m0);
    if (dot(moments.m1, middle) < 0)
        moments.m1 = -moments.m1;
    return moments;
}

} // namespace

HemisphereMoments visibleBesidePolygons(Double3 point, Double3 normal, std::span<const Polygon> polygons)
{
    HemisphereMoments visible{2 * std::numbers::pi, normal * std::numbers::pi};
    for (const Polygon& polygon : polygons)
    {
        Polygon from_point;
        for (const Double3 corner : polygon)
            from_point.push_back(corner - point);
        const Polygon above = clipToHorizon(from_point, normal);
        if (above.size() < 3)
            continue;
        const HemisphereMoments blocked = computeMoments(above);
        visible.m0 -= blocked.m0;
        visible.m1 = visible.m1 - blocked.m1;
    }
    return visible;
}

} // namespace hearth::reference
