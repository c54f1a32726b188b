// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/star_blocks.h"

#include <algorithm>

namespace hearth::clusters
{

StarBlocks::StarBlocks(const Surface& surface, std::span<const uint8_t> open) : offsets_(open.size() + 1, 0)
{
    std::vector<uint32_t> filled(open.size(), 0);
    for (const uint32_t position : surface.positions)
        ++filled[position];
    for (size_t p = 0; p < open.size(); ++p)
        offsets_[p + 1] = offsets_[p] + (filled[p] + uint32_t{kEight} - 1) / uint32_t{kEight};
    blocks_ = std::make_unique_for_overwrite<StarBlock[]>(offsets_.back());
    std::fill(filled.begin(), filled.end(), 0u);
    const auto put = [&](uint32_t center, uint32_t next, uint32_t previous)
    {
        const uint32_t lane = filled[center]++;
        StarBlock& block = blocks_[offsets_[center] + lane / kEight];
        for (int axis = 0; axis < 3; ++axis)
        {
            block.next[axis][lane % kEight] = surface.place_of_position[next][axis];
            block.previous[axis][lane % kEight] = surface.place_of_position[previous][axis];
        }
        const auto name = [&](uint32_t p)
        { return open[p] != 0 ? ~static_cast<int32_t>(p) : static_cast<int32_t>(p); };
        block.next_name[lane % kEight] = name(next);
        block.previous_name[lane % kEight] = name(previous);
    };
    for (size_t f = 0; f < surface.positions.size(); f += 3)
    {
        const uint32_t a = surface.positions[f], b = surface.positions[f + 1], c = surface.positions[f + 2];
        put(a, b, c);
        put(b, c, a);
        put(c, a, b);
    }
    for (size_t p = 0; p < open.size(); ++p)
        for (uint32_t lane = filled[p]; lane % kEight != 0; ++lane)
        {
            StarBlock& block = blocks_[offsets_[p] + lane / kEight];
            const auto repeat = [&](auto& row) { row[lane % kEight] = row[lane % kEight - 1]; };
            for (int axis = 0; axis < 3; ++axis)
            {
                repeat(block.next[axis]);
                repeat(block.previous[axis]);
            }
            repeat(block.next_name);
            repeat(block.previous_name);
        }
}

} // namespace hearth::clusters
