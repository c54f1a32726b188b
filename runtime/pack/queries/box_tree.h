// Tree of boxes that rays walk from near to far.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace hearth::pack
{

/// Part of a line: the points origin + t direction with t from begin to end.
struct Ray
{
    Double3 origin;
    Double3 direction; ///< of any length above 0
    double begin = 0;
    double end = std::numeric_limits<double>::infinity();
};

/// Ray as tests of boxes need it.
struct BoxRay
{
    explicit BoxRay(const Ray& ray);

    std::array<double, 3> origin;
    std::array<double, 3> inverse; ///< of the direction; where that is 0, huge but finite
    double begin;
};

/// Return the t at which a ray enters a box, or a little less, ray.begin inside of it; infinity if it does
/// not before `end`. No point of the ray that lies in the box is missed by rounding.
inline double findEntry(const BoxRay& ray, const Box3& box, double end)
{
    // of a difference and a product: T. Ize, "Robust BVH ray traversal", 2013, with room
    constexpr double kRounding = 1e-15;
    double entry = ray.begin, exit = end;
    for (size_t axis = 0; axis < 3; ++axis)
    {
        const int a = static_cast<int>(axis);
        const double first = (double{box.min[a]} - ray.origin[axis]) * ray.inverse[axis];
        const double second = (double{box.max[a]} - ray.origin[axis]) * ray.inverse[axis];
        entry = std::max(entry, std::min(first, second));
        exit = std::min(exit, std::max(first, second));
    }
    entry *= 1 - kRounding;
    return entry <= exit * (1 + kRounding) ? entry : std::numeric_limits<double>::infinity();
}

class BoxTree
{
public:
    BoxTree() = default;

    /// Empty boxes are left out. Deterministic. Time O(n log n).
    explicit BoxTree(std::span<const Box3> boxes);

    /// Call visit(box, end) for the boxes that a ray meets before `end`, near ones first where they are
    /// apart, until it returns false. The call may lower `end`. Returns false if a call did.
    template <typename Visit>
    bool visit(const BoxRay& ray, double& end, const Visit& visit) const;

private:
    /// Inner node: its first child follows it, `first` is the second. Leaf: items [first, first + count).
    struct Node
    {
        Box3 box;
        uint32_t first = 0;
        uint32_t count = 0; ///< 0: an inner node
    };
    void split(std::span<const Box3> boxes, uint32_t begin, uint32_t end);

    std::vector<Node> nodes_;
    std::vector<uint32_t> items_;
};

template <typename Visit>
bool BoxTree::visit(const BoxRay& ray, double& end, const Visit& visit) const
{
    // halves are equal, so the tree is no deeper than the bits of a count
    std::array<std::pair<uint32_t, double>, 34> waiting;
    size_t count = 0;
    if (!nodes_.empty())
        waiting[count++] = {0, findEntry(ray, nodes_[0].box, end)};
    while (count > 0)
    {
        const auto [index, entry] = waiting[--count];
        if (!(entry < end))
            continue;
        const Node& node = nodes_[index];
        for (uint32_t i = 0; i < node.count; ++i)
            if (!visit(items_[node.first + i], end))
                return false;
        if (node.count > 0)
            continue;
        std::pair<uint32_t, double> near{index + 1, findEntry(ray, nodes_[index + 1].box, end)};
        std::pair<uint32_t, double> far{node.first, findEntry(ray, nodes_[node.first].box, end)};
        if (far.second < near.second)
            std::swap(near, far);
        waiting[count++] = far;
        waiting[count++] = near;
    }
    return true;
}

} // namespace hearth::pack
