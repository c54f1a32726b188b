// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/topology/box_tree.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace hearth::topology
{

namespace
{

constexpr uint32_t kCellBits = 21; ///< three of them fill 64 bits

/// Spread the lowest 21 bits to every third bit.
uint64_t spreadBits(uint64_t bits)
{
    bits = (bits | bits << 32) & 0x001F00000000FFFFu;
    bits = (bits | bits << 16) & 0x001F0000FF0000FFu;
    bits = (bits | bits << 8) & 0x100F00F00F00F00Fu;
    bits = (bits | bits << 4) & 0x10C30C30C30C30C3u;
    bits = (bits | bits << 2) & 0x1249249249249249u;
    return bits;
}

uint64_t mortonCode(Float3 point, const Box3& box)
{
    uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double size = double{box.max[axis]} - double{box.min[axis]};
        const double part = size > 0 ? (double{point[axis]} - double{box.min[axis]}) / size : 0.0;
        const double cell = std::clamp(part, 0.0, 1.0) * double{(1u << kCellBits) - 1};
        code |= spreadBits(static_cast<uint64_t>(cell)) << axis;
    }
    return code;
}

} // namespace

BoxTree::BoxTree(std::span<const Box3> boxes) : order_(boxes.size())
{
    Box3 whole;
    for (const Box3& box : boxes)
        whole.add(box);
    std::vector<std::pair<uint64_t, uint32_t>> codes(boxes.size());
    for (uint32_t i = 0; i < boxes.size(); ++i)
        codes[i] = {mortonCode(boxes[i].center(), whole), i};
    std::sort(codes.begin(), codes.end());
    std::transform(codes.begin(), codes.end(), order_.begin(), [](const auto& code) { return code.second; });

    leaf_count_ = std::bit_ceil(static_cast<uint32_t>((boxes.size() + kLeafBoxes - 1) / kLeafBoxes));
    nodes_.resize(size_t{2} * leaf_count_);
    for (size_t i = 0; i < order_.size(); ++i)
        nodes_[leaf_count_ + i / kLeafBoxes].add(boxes[order_[i]]);
    for (size_t node = leaf_count_ - 1; node > 0; --node)
    {
        nodes_[node].add(nodes_[2 * node]);
        nodes_[node].add(nodes_[2 * node + 1]);
    }
}

} // namespace hearth::topology
