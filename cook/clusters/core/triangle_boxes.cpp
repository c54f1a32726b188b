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
    const size_t count = position_ids_.size() / 3;
    std::vector<Box3> boxes(count);
    std::vector<Box3> run_boxes((count + kRun - 1) / kRun);
    for (uint32_t f = 0; f < count; ++f)
    {
        for (size_t k = 0; k < 3; ++k)
            boxes[f].add(corner(f, k));
        run_boxes[f / kRun].add(boxes[f]);
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

void TriangleBoxes::query(const Box3& box, std::vector<uint32_t>& found)
{
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
                            forEachLane(overlap(boxes_[b], box), [&](size_t k)
                                        { found.push_back(static_cast<uint32_t>(b * kLanes + k)); });
                    });
}

} // namespace hearth::clusters
