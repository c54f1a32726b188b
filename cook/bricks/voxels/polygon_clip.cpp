// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/polygon_clip.h"

namespace hearth::bricks
{

namespace
{

/// Return the intersection of an edge with a plane strictly between its ends. Exactly the same for both
/// directions of the edge.
Double3 cut(const Double3& p, const Double3& q, int axis, double plane)
{
    const bool up = coordinate(p, axis) < coordinate(q, axis);
    const Double3& low = up ? p : q;
    const Double3& high = up ? q : p;
    const double t = (plane - coordinate(low, axis)) / (coordinate(high, axis) - coordinate(low, axis));
    const auto between = [&](double a, double b)
    { return std::clamp(a + (b - a) * t, std::min(a, b), std::max(a, b)); };
    return {axis == 0 ? plane : between(low.x, high.x), axis == 1 ? plane : between(low.y, high.y),
            axis == 2 ? plane : between(low.z, high.z)};
}

} // namespace

Double3 doubleArea(const Polygon& polygon)
{
    Double3 area;
    for (uint32_t i = 2; i < polygon.count; ++i)
        area = area + cross(polygon.points[i - 1] - polygon.points[0], polygon.points[i] - polygon.points[0]);
    return area;
}

void clipToSlab(const Polygon& polygon, int axis, double low, Polygon& part)
{
    const double high = low + 1;
    part.count = 0;
    for (uint32_t i = 0; i < polygon.count; ++i)
    {
        const Double3& p = polygon.points[i];
        const Double3& q = polygon.points[i + 1 < polygon.count ? i + 1 : 0];
        const double from = coordinate(p, axis), to = coordinate(q, axis);
        if (from >= low && from <= high)
            part.add(p);
        if (from < low && to > low)
            part.add(cut(p, q, axis, low));
        if ((from < high && to > high) || (from > high && to < high))
            part.add(cut(p, q, axis, high));
        if (from > low && to < low)
            part.add(cut(p, q, axis, low));
    }
}

} // namespace hearth::bricks
