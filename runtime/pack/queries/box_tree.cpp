// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/queries/box_tree.h"

#include <algorithm>
#include <cmath>

namespace hearth::pack
{

namespace
{

constexpr double kNever = std::numeric_limits<double>::infinity();

// Rounding of a difference and a product: T. Ize, "Robust BVH ray traversal", 2013, with room.
constexpr double kRounding = 1e-15;

// Small leaves: visiting an item costs more than testing a node.
constexpr uint32_t kMaxLeafItems = 2;

} // namespace

BoxRay::BoxRay(const Ray& ray)
    : origin{ray.origin.x, ray.origin.y, ray.origin.z},
      inverse{1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z},
      begin(ray.begin)
{
}

double findEntry(const BoxRay& ray, const Box3& box, double end)
{
    double entry = ray.begin, exit = end;
    for (int axis = 0; axis < 3; ++axis)
    {
        const auto a = static_cast<size_t>(axis);
        const double low = double{box.min[axis]} - ray.origin[a],
                     high = double{box.max[axis]} - ray.origin[a];
        if (std::isinf(ray.inverse[a]))
        {
            if (low > 0 || high < 0)
                return kNever;
            continue;
        }
        const double first = low * ray.inverse[a], second = high * ray.inverse[a];
        const double near = std::min(first, second), far = std::max(first, second);
        entry = std::max(entry, near - std::abs(near) * kRounding);
        exit = std::min(exit, far + std::abs(far) * kRounding);
    }
    return entry <= exit ? entry : kNever;
}

BoxTree::BoxTree(std::span<const Box3> boxes)
{
    for (uint32_t i = 0; i < boxes.size(); ++i)
        if (!boxes[i].empty())
            items_.push_back(i);
    if (!items_.empty())
        split(boxes, 0, static_cast<uint32_t>(items_.size()));
}

void BoxTree::split(std::span<const Box3> boxes, uint32_t begin, uint32_t end)
{
    const size_t index = nodes_.size();
    nodes_.emplace_back();
    Box3 box, centers;
    for (uint32_t i = begin; i < end; ++i)
    {
        box.add(boxes[items_[i]]);
        centers.add(boxes[items_[i]].center());
    }
    nodes_[index].box = box;
    if (end - begin <= kMaxLeafItems)
    {
        nodes_[index].first = begin;
        nodes_[index].count = end - begin;
        return;
    }
    const Float3 size = centers.max - centers.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const uint32_t middle = begin + (end - begin) / 2;
    const auto at = [&](uint32_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](uint32_t a, uint32_t b) {
                         return std::pair(boxes[a].center()[axis], a) < std::pair(boxes[b].center()[axis], b);
                     });
    split(boxes, begin, middle);
    nodes_[index].first = static_cast<uint32_t>(nodes_.size());
    split(boxes, middle, end);
}

} // namespace hearth::pack
