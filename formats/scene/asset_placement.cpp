// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/asset_placement.h"

#include <algorithm>
#include <vector>

namespace hearth::formats
{

namespace
{

/// Distance of the origin from an asset's box, as a share of its largest side, up to which the asset counts
/// as unplaced. Covers models that float above the floor, or whose pivot is a hinge; a neighbour that was
/// placed is a whole side away.
constexpr float kOriginSlack = 0.25f;

/// Overlap of two unplaced assets, as a share of the smaller one's side along each axis; tiles that meet
/// share nothing.
constexpr float kOverlapShare = 0.5f;

bool isNearOrigin(const Box3& box)
{
    const Float3 size = box.max - box.min;
    const float slack = kOriginSlack * std::max({size.x, size.y, size.z});
    for (int axis = 0; axis < 3; ++axis)
        if (box.min[axis] > slack || box.max[axis] < -slack)
            return false;
    return true;
}

bool overlapHeavily(const Box3& a, const Box3& b)
{
    for (int axis = 0; axis < 3; ++axis)
    {
        const float smaller = std::min(a.max[axis] - a.min[axis], b.max[axis] - b.min[axis]);
        const float shared = std::min(a.max[axis], b.max[axis]) - std::max(a.min[axis], b.min[axis]);
        if (shared < kOverlapShare * smaller)
            return false;
    }
    return true;
}

} // namespace

bool areUnplaced(std::span<const Box3> boxes)
{
    std::vector<Box3> around;
    std::ranges::copy_if(boxes, std::back_inserter(around), isNearOrigin);
    size_t overlapping = 0;
    for (const Box3& box : around)
    {
        const auto overlaps = static_cast<size_t>(
            std::ranges::count_if(around, [&](const Box3& other) { return overlapHeavily(box, other); }));
        // counts itself
        overlapping += overlaps >= 2 && (overlaps - 1) * 2 >= around.size() - 1 ? size_t{1} : size_t{0};
    }
    return overlapping >= 2 && overlapping * 4 >= boxes.size() * 3;
}

} // namespace hearth::formats
