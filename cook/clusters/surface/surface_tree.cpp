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

constexpr uint32_t kLeafTriangles = 4;

// Depth of a tree that halves 2^32 triangles, with the sibling of each node on the path.
constexpr size_t kMaxStack = 64;

double edgeDistance2(Double3 point, Double3 a, Double3 b)
{
    const Double3 edge = b - a;
    const double length2 = dot(edge, edge);
    const double t = length2 > 0 ? std::clamp(dot(point - a, edge) / length2, 0.0, 1.0) : 0.0;
    const Double3 away = point - (a + edge * t);
    return dot(away, away);
}

double boxDistance2(Double3 p, const Box3& box)
{
    const double x = std::max({double{box.min.x} - p.x, p.x - double{box.max.x}, 0.0});
    const double y = std::max({double{box.min.y} - p.y, p.y - double{box.max.y}, 0.0});
    const double z = std::max({double{box.min.z} - p.z, p.z - double{box.max.z}, 0.0});
    return x * x + y * y + z * z;
}

} // namespace

double distance2(Double3 point, const Corners3& triangle)
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
        {
            const Double3 away = ap - (ab * v + ac * w);
            return dot(away, away);
        }
    }
    return std::min({edgeDistance2(point, triangle[0], triangle[1]),
                     edgeDistance2(point, triangle[1], triangle[2]),
                     edgeDistance2(point, triangle[2], triangle[0])});
}

SurfaceTree::SurfaceTree(const SurfaceView& surface)
    : surface_(surface), order_(surface.corners.triangleCount())
{
    HEARTH_ASSERT(!order_.empty() && allBelow(surface.corners, surface.positions.size()));
    const IdRange<TriangleId> all = surface.corners.triangles();
    std::copy(all.begin(), all.end(), order_.begin());
    nodes_.reserve(order_.size());
    build(0, static_cast<uint32_t>(order_.size()));
}

Corners3 SurfaceTree::triangle(TriangleId triangle) const
{
    const auto [a, b, c] = surface_.corners.triangle(triangle);
    return {widen(surface_.positions[a]), widen(surface_.positions[b]), widen(surface_.positions[c])};
}

/// Halve the triangles along the longest side of their centers' box. Recursion is as deep as the tree, 32 at
/// most.
void SurfaceTree::build(uint32_t first, uint32_t count)
{
    const auto center = [&](TriangleId triangle, int axis)
    {
        float sum = 0;
        for (const VertexId vertex : surface_.corners.triangle(triangle))
            sum += surface_.positions[vertex][axis];
        return sum;
    };
    const auto at = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back({});
    Box3 centers;
    for (uint32_t i = first; i < first + count; ++i)
    {
        for (const VertexId vertex : surface_.corners.triangle(order_[i]))
            nodes_[at].box.add(surface_.positions[vertex]);
        centers.add(Float3{center(order_[i], 0), center(order_[i], 1), center(order_[i], 2)});
    }
    nodes_[at].first = first;
    nodes_[at].count = count;
    if (count <= kLeafTriangles)
        return;
    const Float3 size = centers.max - centers.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const uint32_t half = count / 2;
    std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                     [&](TriangleId a, TriangleId b)
                     {
                         const float ca = center(a, axis), cb = center(b, axis);
                         return ca != cb ? ca < cb : a < b;
                     });
    nodes_[at].count = 0;
    build(first, half);
    nodes_[at].second = static_cast<uint32_t>(nodes_.size());
    build(first + half, count - half);
}

SurfaceTree::Nearest SurfaceTree::nearest(Double3 point, double enough2, TriangleId hint) const
{
    HEARTH_RUNTIME_ASSERT(toIndex(hint) < order_.size());
    Nearest best{hint, distance2(point, triangle(hint))};
    struct Entry
    {
        uint32_t node;
        double distance2;
    };
    std::array<Entry, kMaxStack> stack;
    size_t size = 0;
    stack[size++] = {0, boxDistance2(point, nodes_[0].box)};
    while (size > 0 && best.distance2 > enough2)
    {
        const Entry entry = stack[--size];
        if (entry.distance2 >= best.distance2)
            continue;
        const Node& node = nodes_[entry.node];
        for (uint32_t i = node.first; i < node.first + node.count; ++i)
            if (const double found = distance2(point, triangle(order_[i])); found < best.distance2)
                best = {order_[i], found};
        if (node.count > 0)
            continue;
        Entry near{entry.node + 1, boxDistance2(point, nodes_[entry.node + 1].box)};
        Entry far{node.second, boxDistance2(point, nodes_[node.second].box)};
        if (far.distance2 < near.distance2)
            std::swap(near, far);
        HEARTH_RUNTIME_ASSERT(size + 2 <= kMaxStack);
        stack[size++] = far;
        stack[size++] = near;
    }
    return best;
}

} // namespace hearth::clusters
