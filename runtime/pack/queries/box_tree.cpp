// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/queries/box_tree.h"

#include <algorithm>
#include <cmath>

namespace hearth::pack
{

namespace
{

// Small leaves: visiting an item costs more than testing a node.
constexpr uint32_t kMaxLeafItems = 2;

/// Return 1 / value, at most so much that its product with a float is finite.
double invert(double value)
{
    constexpr double kHuge = 1e200;
    return std::abs(value) * kHuge > 1 ? 1 / value : kHuge;
}

} // namespace

BoxRay::BoxRay(const Ray& ray)
    : origin{ray.origin.x, ray.origin.y, ray.origin.z},
      inverse{invert(ray.direction.x), invert(ray.direction.y), invert(ray.direction.z)},
      begin(ray.begin)
{
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
