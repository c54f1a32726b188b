// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/triangle_boxes.h"

#include <algorithm>

namespace hearth::clusters
{

namespace
{

constexpr size_t kBlocksPerRun = 4;
constexpr size_t kRun = kLanes * kBlocksPerRun;

} // namespace

void TriangleBoxes::makeBoxes()
{
    const size_t count = position_ids_.triangleCount();
    IdVector<TriangleId, Box3> boxes(count);
    std::vector<Box3> run_boxes((count + kRun - 1) / kRun);
    for (const TriangleId triangle : boxes.ids())
    {
        for (const PositionId position : position_ids_.triangle(triangle))
            boxes[triangle].add(positions_[position]);
        run_boxes[toIndex(triangle) / kRun].add(boxes[triangle]);
    }
    boxes_ = makeBlocks(boxes);
    run_boxes_ = makeBlocks(run_boxes);
}

std::vector<TriangleBoxes::BoxBlock> TriangleBoxes::makeBlocks(std::span<const Box3> boxes)
{
    // unused lanes are empty boxes
    std::vector<BoxBlock> blocks((boxes.size() + kLanes - 1) / kLanes,
                                 {splat(Box3{}.min), splat(Box3{}.max)});
    for (size_t i = 0; i < boxes.size(); ++i)
    {
        BoxBlock& block = blocks[i / kLanes];
        const size_t lane = i % kLanes;
        block.min.x[lane] = boxes[i].min.x;
        block.min.y[lane] = boxes[i].min.y;
        block.min.z[lane] = boxes[i].min.z;
        block.max.x[lane] = boxes[i].max.x;
        block.max.y[lane] = boxes[i].max.y;
        block.max.z[lane] = boxes[i].max.z;
    }
    return blocks;
}

LaneMask TriangleBoxes::overlap(const BoxBlock& blocks, const Box3& box)
{
    const LaneVector low = splat(box.min);
    const LaneVector high = splat(box.max);
    return (blocks.min.x <= high.x) & (blocks.max.x >= low.x) & (blocks.min.y <= high.y) &
           (blocks.max.y >= low.y) & (blocks.min.z <= high.z) & (blocks.max.z >= low.z);
}

void TriangleBoxes::query(const Box3& box, std::vector<TriangleId>& found)
{
    HEARTH_RUNTIME_ASSERT(!box.empty());
    if (boxes_.empty())
        makeBoxes();
    found.clear();
    const auto forEachLane = [](LaneMask mask, auto visit)
    {
        if (anyLane(mask))
            for (size_t lane = 0; lane < kLanes; ++lane)
                if (mask[lane] != 0)
                    visit(lane);
    };
    for (size_t r = 0; r < run_boxes_.size(); ++r)
        forEachLane(overlap(run_boxes_[r], box),
                    [&](size_t lane)
                    {
                        const size_t first = (r * kLanes + lane) * kBlocksPerRun;
                        const size_t last = std::min(first + kBlocksPerRun, boxes_.size());
                        for (size_t b = first; b < last; ++b)
                            forEachLane(overlap(boxes_[b], box),
                                        [&](size_t k) { found.push_back(toId<TriangleId>(b * kLanes + k)); });
                    });
}

} // namespace hearth::clusters
