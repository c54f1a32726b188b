// Bounding volume hierarchy of axis-aligned boxes over triangles, for queries by distance.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/assert.h"
#include "formats/base/double3.h"
#include "formats/base/math.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace hearth::mesh
{

/// Return the squared distance of a point to a box; 0 inside.
inline double boxDistance2(Double3 point, const Box3& box)
{
    const double x = std::max({double{box.min.x} - point.x, point.x - double{box.max.x}, 0.0});
    const double y = std::max({double{box.min.y} - point.y, point.y - double{box.max.y}, 0.0});
    const double z = std::max({double{box.min.z} - point.z, point.z - double{box.max.z}, 0.0});
    return x * x + y * y + z * z;
}

/// Return a lower bound of the squared distance, in floats, which are faster than doubles.
inline double boxDistance2(Float3 point, const Box3& box)
{
    const float x = std::max(std::max(box.min.x - point.x, point.x - box.max.x), 0.0f);
    const float y = std::max(std::max(box.min.y - point.y, point.y - box.max.y), 0.0f);
    const float z = std::max(std::max(box.min.z - point.z, point.z - box.max.z), 0.0f);
    constexpr float kRounded = 1 - 0x1p-20f; // six operations, each off by 2^-24
    return double{(x * x + y * y + z * z) * kRounded};
}

class TriangleTree
{
public:
    TriangleTree() = default;

    /// Build the tree: each node is split at the median, along the longest side of the box of its triangles'
    /// centers. Deterministic; triangles with equal centers are ordered by their numbers.
    /// corners  returns the three corners of triangle i as std::array<Float3, 3>
    template <typename Corners>
    TriangleTree(uint32_t triangle_count, const Corners& corners) : order_(triangle_count)
    {
        std::iota(order_.begin(), order_.end(), 0u);
        nodes_.reserve(triangle_count);
        if (triangle_count > 0)
            build(0, triangle_count, corners);
    }

    bool empty() const { return nodes_.empty(); }

    /// Return the triangles, leaf by leaf.
    const std::vector<uint32_t>& order() const { return order_; }

    /// Visit leaves, nearer ones first as far as boxes tell.
    /// isNeeded  returns whether triangles at a squared distance or beyond can still change the result
    /// visit     is called with an index of order()
    /// point     a Double3, or a Float3, for which boxes are faster
    template <typename Point, typename IsNeeded, typename Visit>
    void visitNearest(Point point, const IsNeeded& isNeeded, const Visit& visit) const
    {
        traverse(
            point, [&](double distance2, const Box3&) { return isNeeded(distance2); }, visit);
    }

    /// Visit leaves, those that are nearer to a point first as far as boxes tell.
    /// isNeeded  returns whether triangles within a box matter
    /// visit     as visitNearest's
    template <typename Point, typename IsNeeded, typename Visit>
    void visitBoxes(Point point, const IsNeeded& isNeeded, const Visit& visit) const
    {
        traverse(
            point, [&](double, const Box3& box) { return isNeeded(box); }, visit);
    }

private:
    /// Visit leaves, nearer ones first. isNeeded is called with the squared distance of a box, and the box.
    template <typename Point, typename IsNeeded, typename Visit>
    void traverse(Point point, const IsNeeded& isNeeded, const Visit& visit) const
    {
        struct Entry
        {
            uint32_t node;
            double distance2;
        };
        if (nodes_.empty())
            return;
        std::array<Entry, kMaxStack> stack;
        size_t size = 0;
        stack[size++] = {0, boxDistance2(point, nodes_[0].box)};
        while (size > 0)
        {
            const Entry entry = stack[--size];
            const Node& node = nodes_[entry.node];
            if (!isNeeded(entry.distance2, node.box))
                continue;
            for (uint32_t i = node.first; i < node.first + node.count; ++i)
                visit(i);
            if (node.count > 0)
                continue;
            Entry near{entry.node + 1, boxDistance2(point, nodes_[entry.node + 1].box)};
            Entry far{node.second, boxDistance2(point, nodes_[node.second].box)};
            if (far.distance2 < near.distance2)
                std::swap(near, far);
            stack[size++] = far;
            stack[size++] = near;
        }
    }

    /// Leaf with `count` triangles; or inner node with count 0, whose first child follows it and whose second
    /// child is at `second`.
    struct Node
    {
        Box3 box;
        uint32_t first = 0;
        uint32_t count = 0;
        uint32_t second = 0;
    };

    static constexpr uint32_t kLeafTriangles = 4;
    /// depth of a tree that halves 2^32 triangles, plus one sibling for each node on the path
    static constexpr size_t kMaxStack = 64;

    /// Build the node of order_[first .. first + count) and those below. The recursion is as deep as the
    /// tree, at most 32.
    template <typename Corners>
    void build(uint32_t first, uint32_t count, const Corners& corners)
    {
        const auto center = [&](uint32_t triangle, int axis)
        {
            const std::array<Float3, 3> c = corners(triangle);
            return c[0][axis] + c[1][axis] + c[2][axis];
        };
        const auto at = static_cast<uint32_t>(nodes_.size());
        nodes_.push_back({});
        Box3 centers;
        for (uint32_t i = first; i < first + count; ++i)
        {
            const std::array<Float3, 3> c = corners(order_[i]);
            for (const Float3 corner : c)
                nodes_[at].box.add(corner);
            centers.add(c[0] + c[1] + c[2]);
        }
        nodes_[at].first = first;
        nodes_[at].count = count;
        if (count <= kLeafTriangles)
            return;
        const Float3 size = centers.max - centers.min;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const uint32_t half = count / 2;
        std::nth_element(order_.begin() + first, order_.begin() + first + half,
                         order_.begin() + first + count,
                         [&](uint32_t a, uint32_t b)
                         {
                             const float ca = center(a, axis), cb = center(b, axis);
                             return ca != cb ? ca < cb : a < b;
                         });
        nodes_[at].count = 0;
        build(first, half, corners);
        nodes_[at].second = static_cast<uint32_t>(nodes_.size());
        build(first + half, count - half, corners);
    }

    std::vector<uint32_t> order_;
    std::vector<Node> nodes_;
};

} // namespace hearth::mesh
