// Finds the triangles of a group that touch a box.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/index_types.h"
#include "cook/clusters/core/triangle_block.h"
#include "formats/base/assert.h"
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
    /// positions  finite
    TriangleBoxes(CornerSpan<const PositionId> position_ids, IdSpan<PositionId, const Float3> positions)
        : position_ids_(position_ids), positions_(positions)
    {
        HEARTH_RUNTIME_ASSERT(allBelow(position_ids, positions.size()));
    }

    DistanceTriangle triangle(TriangleId triangle) const
    {
        const auto [a, b, c] = position_ids_.triangle(triangle);
        return makeDistanceTriangle(positions_[a], positions_[b], positions_[c]);
    }

    /// Write the triangles whose boxes touch the given one to `found`, ascending.
    void query(const Box3& box, std::vector<TriangleId>& found);

private:
    /// Four boxes.
    struct BoxBlock
    {
        LaneVector min;
        LaneVector max;
    };
    void makeBoxes();
    static std::vector<BoxBlock> makeBlocks(std::span<const Box3> boxes);
    static LaneMask overlap(const BoxBlock& blocks, const Box3& box);

    CornerSpan<const PositionId> position_ids_;
    IdSpan<PositionId, const Float3> positions_;
    std::vector<BoxBlock> boxes_; ///< empty before the first query
    std::vector<BoxBlock> run_boxes_;
};

} // namespace hearth::clusters
