// Closest point on a triangle: C. Ericson, "Real-Time Collision Detection", 2005, 5.1.5.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/mesh/closest_point.h"

#include <algorithm>

namespace hearth::visibility
{

namespace
{

constexpr uint32_t kLeafTriangles = 4;

// Depth of a tree that halves 2^32 triangles, plus one sibling for each node on the path.
constexpr size_t kMaxStack = 64;

double boxDistance2(Double3 p, const Box3& box)
{
    const double x = std::max({double{box.min.x} - p.x, p.x - double{box.max.x}, 0.0});
    const double y = std::max({double{box.min.y} - p.y, p.y - double{box.max.y}, 0.0});
    const double z = std::max({double{box.min.z} - p.z, p.z - double{box.max.z}, 0.0});
    return x * x + y * y + z * z;
}

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
    for (size_t t = 0; t < triangle_count; ++t)
    {
        for (size_t k = 0; k < 3; ++k)
            triangles_[t].corners[k] = mesh.positions[mesh.indices[t * 3 + k]];
        triangles_[t].triangle = static_cast<uint32_t>(t);
    }
    if (triangle_count == 0)
        return;
    nodes_.reserve(triangle_count);
    build(0, static_cast<uint32_t>(triangle_count));
    for (uint32_t i = 0; i < triangle_count; ++i)
        slot_of_triangle_[triangles_[i].triangle] = i;
}

/// Split the triangles at the median, along the longest side of the box of their centers. The recursion is as
/// deep as the tree, at most 32.
void ClosestPoint::build(uint32_t first, uint32_t count)
{
    const auto center = [](const Triangle& item, int axis)
    { return item.corners[0][axis] + item.corners[1][axis] + item.corners[2][axis]; };
    const auto at = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back({});
    Box3 centers;
    for (uint32_t i = first; i < first + count; ++i)
    {
        const Triangle& item = triangles_[i];
        for (const Float3 corner : item.corners)
            nodes_[at].box.add(corner);
        centers.add(Float3{center(item, 0), center(item, 1), center(item, 2)});
    }
    nodes_[at].first = first;
    nodes_[at].count = count;
    if (count <= kLeafTriangles)
        return;
    const Float3 size = centers.max - centers.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const uint32_t half = count / 2;
    std::nth_element(triangles_.begin() + first, triangles_.begin() + first + half,
                     triangles_.begin() + first + count,
                     [&](const Triangle& a, const Triangle& b)
                     {
                         const float ca = center(a, axis), cb = center(b, axis);
                         return ca != cb ? ca < cb : a.triangle < b.triangle;
                     });
    nodes_[at].count = 0;
    build(first, half);
    nodes_[at].second = static_cast<uint32_t>(nodes_.size());
    build(first + half, count - half);
}

void ClosestPoint::visit(Double3 point, Double3 normal, const Triangle& item, Hit& best) const
{
    const Double3 a = widen(item.corners[0]);
    const Double3 ab = widen(item.corners[1]) - a, ac = widen(item.corners[2]) - a, ap = point - a;
    const bool any_side = normal.x == 0 && normal.y == 0 && normal.z == 0;
    if (!any_side && !(dot(cross(ab, ac), normal) > 0))
        return;
    const Weights weights = closestPointWeights(ab, ac, ap);
    const Double3 away = ap - (ab * weights.u + ac * weights.v);
    const double distance2 = dot(away, away);
    if (distance2 < best.distance2 || (best.triangle == kInvalidIndex && distance2 <= best.distance2))
        best = {item.triangle, static_cast<float>(weights.u), static_cast<float>(weights.v), distance2};
}

ClosestPoint::Hit ClosestPoint::find(Float3 point, Float3 normal, double limit2, uint32_t hint) const
{
    Hit best{kInvalidIndex, 0, 0, limit2};
    if (nodes_.empty())
        return best;
    const Double3 p = widen(point), n = widen(normal);
    if (hint != kInvalidIndex)
        visit(p, n, triangles_[slot_of_triangle_[hint]], best);
    struct Entry
    {
        uint32_t node;
        double distance2;
    };
    std::array<Entry, kMaxStack> stack;
    size_t size = 0;
    stack[size++] = {0, boxDistance2(p, nodes_[0].box)};
    while (size > 0)
    {
        const Entry entry = stack[--size];
        if (entry.distance2 > best.distance2 ||
            (entry.distance2 == best.distance2 && best.triangle != kInvalidIndex))
            continue;
        const Node& node = nodes_[entry.node];
        for (uint32_t i = node.first; i < node.first + node.count; ++i)
            visit(p, n, triangles_[i], best);
        if (node.count > 0)
            continue;
        Entry near{entry.node + 1, boxDistance2(p, nodes_[entry.node + 1].box)};
        Entry far{node.second, boxDistance2(p, nodes_[node.second].box)};
        if (far.distance2 < near.distance2)
            std::swap(near, far);
        stack[size++] = far;
        stack[size++] = near;
    }
    return best;
}

} // namespace hearth::visibility
