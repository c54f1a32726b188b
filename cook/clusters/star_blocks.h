// The facets around each position of a surface, laid out to be looked at eight at a time.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/surface.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hearth::clusters
{

inline constexpr size_t kEight = 8;

/// Up to eight facets around one position, the center: the two other corners of each, in their order. What is left
/// over repeats the last facet.
struct alignas(32) StarBlock
{
    float next[3][kEight];
    float previous[3][kEight];
    int32_t next_name[kEight]; ///< the position, negated (~) where the surface is open there
    int32_t previous_name[kEight];
};

class StarBlocks
{
public:
    /// open  for each position: whether the facets do not close around it
    StarBlocks(const Surface& surface, std::span<const uint8_t> open);

    std::span<const StarBlock> of(uint32_t position) const
    {
        return {blocks_.get() + offsets_[position], offsets_[position + 1] - offsets_[position]};
    }

private:
    std::vector<uint32_t> offsets_;
    std::unique_ptr<StarBlock[]>
        blocks_; ///< not set to zero first: that would take a tenth of the whole measuring
};

} // namespace hearth::clusters
