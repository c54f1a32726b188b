// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/surface/convex.h"

#include "cook/proxy/surface/proxy_tables.h"
#include "formats/base/double3.h"

#include <algorithm>

namespace hearth::proxy
{

namespace
{

/// Return six times the volume inside of a closed surface; below 0 if it faces inwards.
double measureVolume(const Surface& surface)
{
    const Double3 origin = widen(surface.positions.front());
    double volume = 0;
    for (size_t t = 0; t < surface.triangleCount(); ++t)
    {
        const auto [a, b, c] = surface.corners(t);
        volume += dot(widen(a) - origin, cross(widen(b) - origin, widen(c) - origin));
    }
    return volume;
}

/// True if all positions lie behind the plane of a triangle, or less than `tolerance` in front of it. A
/// triangle that is no higher than that has no plane to speak of.
bool isBehind(const Surface& surface, size_t triangle, double tolerance)
{
    const auto [a, b, c] = surface.corners(triangle);
    const Double3 origin = widen(a);
    const Double3 ab = widen(b) - origin, ac = widen(c) - origin;
    const Double3 normal = cross(ab, ac);
    const double limit = tolerance * length(normal);
    if (length(normal) <= tolerance * std::max({length(ab), length(ac), length(ac - ab)}))
        return true;
    for (const Float3 position : surface.positions)
        if (dot(normal, widen(position) - origin) > limit)
            return false;
    return true;
}

} // namespace

ConvexFault findConvexFault(const Surface& surface)
{
    if (surface.positions.size() > kMaxConvexPositions)
        return ConvexFault::too_large;
    if (!isClosed(surface))
        return ConvexFault::open;
    if (!(measureVolume(surface) > 0))
        return ConvexFault::inside_out;
    const double tolerance = kConvexTolerance * double{findDiagonal(surface)};
    for (size_t t = 0; t < surface.triangleCount(); ++t)
        if (!isBehind(surface, t, tolerance))
            return ConvexFault::dented;
    return ConvexFault::none;
}

} // namespace hearth::proxy
