// Nearest point of a triangle: C. Ericson, "Real-Time Collision Detection", 2005, 5.1.5; needles fall back to
// edges.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/surface_tree.h"

#include "formats/base/assert.h"

#include <algorithm>

namespace hearth::clusters
{

namespace
{

Double3 offsetFromEdge(Double3 point, Double3 a, Double3 b)
{
    const Double3 edge = b - a;
    const double length2 = dot(edge, edge);
    const double t = length2 > 0 ? std::clamp(dot(point - a, edge) / length2, 0.0, 1.0) : 0.0;
    return point - (a + edge * t);
}

} // namespace

Double3 offsetFromTriangle(Double3 point, const Corners3& triangle)
{
    const Double3 ab = triangle[1] - triangle[0];
    const Double3 ac = triangle[2] - triangle[0];
    const Double3 ap = point - triangle[0];
    const double ab_ab = dot(ab, ab), ab_ac = dot(ab, ac), ac_ac = dot(ac, ac);
    const double ab_ap = dot(ab, ap), ac_ap = dot(ac, ap);
    const double det = ab_ab * ac_ac - ab_ac * ab_ac;
    // below this the plane of a needle is rounding
    if (det > 1e-12 * ab_ab * ac_ac)
    {
        const double v = (ac_ac * ab_ap - ab_ac * ac_ap) / det;
        const double w = (ab_ab * ac_ap - ab_ac * ab_ap) / det;
        if (v >= 0 && w >= 0 && v + w <= 1)
            return ap - (ab * v + ac * w);
    }
    return std::min({offsetFromEdge(point, triangle[0], triangle[1]),
                     offsetFromEdge(point, triangle[1], triangle[2]),
                     offsetFromEdge(point, triangle[2], triangle[0])},
                    [](Double3 a, Double3 b) { return dot(a, a) < dot(b, b); });
}

double distance2(Double3 point, const Corners3& triangle)
{
    const Double3 offset = offsetFromTriangle(point, triangle);
    return dot(offset, offset);
}

SurfaceTree::SurfaceTree(const SurfaceView& surface)
    : surface_(surface),
      tree_(static_cast<uint32_t>(surface.corners.triangleCount()),
            [&surface](uint32_t triangle) -> std::array<Float3, 3>
            {
                const auto [a, b, c] = surface.corners.triangle(TriangleId{triangle});
                return {surface.positions[a], surface.positions[b], surface.positions[c]};
            })
{
    HEARTH_ASSERT(!tree_.empty() && allBelow(surface.corners, surface.positions.size()));
}

Corners3 SurfaceTree::triangle(TriangleId triangle) const
{
    const auto [a, b, c] = surface_.corners.triangle(triangle);
    return {widen(surface_.positions[a]), widen(surface_.positions[b]), widen(surface_.positions[c])};
}

SurfaceTree::Nearest SurfaceTree::nearest(Double3 point, double enough2, TriangleId hint) const
{
    HEARTH_RUNTIME_ASSERT(toIndex(hint) < tree_.order().size());
    Nearest best{hint, distance2(point, triangle(hint))};
    tree_.visitNearest(
        point,
        [&](double box_distance2) { return best.distance2 > enough2 && box_distance2 < best.distance2; },
        [&](uint32_t i)
        {
            const TriangleId candidate{tree_.order()[i]};
            if (const double found = distance2(point, triangle(candidate)); found < best.distance2)
                best = {candidate, found};
        });
    return best;
}

} // namespace hearth::clusters
