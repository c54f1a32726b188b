// Finds the triangles of a group that touch a box.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/triangle_block.h"
#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Bounding boxes of triangles, four side by side, below boxes of runs of sixteen. A group's triangles come
/// cluster by cluster, so runs are compact. A group asks so rarely that a better tree would cost more than it
/// saves; the boxes are built at the first query.
class TriangleBoxes
{
public:
    /// position_ids  position ids, three for each triangle
    /// positions     position of each id, finite
    TriangleBoxes(std::span<const uint32_t> position_ids, std::span<const Float3> positions)
        : position_ids_(position_ids), positions_(positions)
    {
    }

    DistanceTriangle triangle(uint32_t f) const
    {
        return makeDistanceTriangle(corner(f, 0), corner(f, 1), corner(f, 2));
    }

    /// Write the triangles whose boxes touch the given one to `found`, ascending.
    void query(const Box3& box, std::vector<uint32_t>& found);

private:
    /// Four boxes.
    struct BoxBlock
    {
        LaneVector min;
        LaneVector max;
    };
    Float3 corner(uint32_t f, size_t k) const { return positions_[position_ids_[size_t{f} * 3 + k]]; }
    void makeBoxes();
    static std::vector<BoxBlock> makeBlocks(std::span<const Box3> boxes);
    static LaneMask overlap(const BoxBlock& blocks, const Box3& box);

    std::span<const uint32_t> position_ids_;
    std::span<const Float3> positions_;
    std::vector<BoxBlock> boxes_; ///< empty before the first query
    std::vector<BoxBlock> run_boxes_;
};

} // namespace hearth::clusters
