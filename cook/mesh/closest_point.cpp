// Closest point on a triangle: C. Ericson, "Real-Time Collision Detection", 2005, 5.1.5.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/closest_point.h"

#include <algorithm>
#include <limits>

namespace hearth::mesh
{

namespace
{

/// Return a / (a + b), for a and b at least 0 apart from rounding errors. An edge of length 0 gives 0, its
/// first end.
double edgeFraction(double a, double b)
{
    return a > 0 && a + b > 0 ? std::min(a / (a + b), 1.0) : 0.0;
}

struct Weights
{
    double u;
    double v;
};

/// Compute the weights of corners b and c at the point of the triangle closest to p.
Weights closestPointWeights(Double3 ab, Double3 ac, Double3 ap)
{
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0)
        return {0, 0};
    const Double3 bp = ap - ab;
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3)
        return {1, 0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
        return {edgeFraction(d1, -d3), 0};
    const Double3 cp = ap - ac;
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6)
        return {0, 1};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
        return {0, edgeFraction(d2, -d6)};
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    {
        const double w = edgeFraction(d4 - d3, d5 - d6);
        return {1 - w, w};
    }
    const double sum = va + vb + vc;
    return sum > 0 ? Weights{vb / sum, vc / sum} : Weights{0, 0};
}

} // namespace

ClosestPoint::ClosestPoint(const MeshView& mesh, size_t triangle_count)
    : triangles_(triangle_count), slot_of_triangle_(triangle_count)
{
    const auto corners = [&mesh](uint32_t triangle) -> std::array<Float3, 3>
    {
        const auto position = [&](size_t k)
        { return mesh.positions[mesh.indices[size_t{triangle} * 3 + k]]; };
        return {position(0), position(1), position(2)};
    };
    tree_ = TriangleTree(static_cast<uint32_t>(triangle_count), corners);
    for (uint32_t i = 0; i < triangle_count; ++i)
    {
        const uint32_t triangle = tree_.order()[i];
        const std::array<Float3, 3> c = corners(triangle);
        const Double3 face = cross(widen(c[1]) - widen(c[0]), widen(c[2]) - widen(c[0]));
        const double size = length(face);
        triangles_[i] = {c, triangle, size > 0 ? face * (1 / size) : Double3{}};
        slot_of_triangle_[triangle] = i;
    }
}

void ClosestPoint::visit(const Query& query, const Triangle& item, Hit& best) const
{
    if (!query.any_side && !(dot(item.normal, query.normal) > query.min_cosine))
        return;
    const Double3 a = widen(item.corners[0]);
    const Double3 ab = widen(item.corners[1]) - a, ac = widen(item.corners[2]) - a, ap = query.point - a;
    const Weights weights = closestPointWeights(ab, ac, ap);
    const Double3 away = ap - (ab * weights.u + ac * weights.v);
    const double distance2 = dot(away, away);
    if (distance2 < best.distance2 || (best.triangle == kInvalidIndex && distance2 <= best.distance2))
        best = {item.triangle, static_cast<float>(weights.u), static_cast<float>(weights.v), distance2};
}

ClosestPoint::Hit ClosestPoint::find(Float3 point, Float3 normal, double limit2, uint32_t hint,
                                     double min_cosine) const
{
    Hit best{kInvalidIndex, 0, 0, limit2};
    if (tree_.empty())
        return best;
    const Query query{widen(point), widen(normal), normal == Float3{}, min_cosine};
    if (hint != kInvalidIndex)
        visit(query, triangles_[slot_of_triangle_[hint]], best);
    tree_.visitNearest(
        point,
        [&](double box_distance2)
        {
            return box_distance2 < best.distance2 ||
                   (box_distance2 == best.distance2 && best.triangle == kInvalidIndex);
        },
        [&](uint32_t i) { visit(query, triangles_[i], best); });
    return best;
}

ClosestPoint::Hit ClosestPoint::findAnywhere(Float3 point, Float3 normal, uint32_t hint,
                                             double min_cosine) const
{
    constexpr double kAnyDistance = std::numeric_limits<double>::infinity();
    Hit found = find(point, normal, kAnyDistance, hint, min_cosine);
    if (found.triangle == kInvalidIndex)
        found = find(point, normal, kAnyDistance, hint);
    return found.triangle != kInvalidIndex ? found : find(point, {}, kAnyDistance, hint);
}

double ClosestPoint::findDistance2(Float3 point, uint32_t triangle) const
{
    Hit hit{kInvalidIndex, 0, 0, std::numeric_limits<double>::infinity()};
    visit({widen(point), {}, true, 0}, triangles_[slot_of_triangle_[triangle]], hit);
    return hit.distance2;
}

} // namespace hearth::mesh
