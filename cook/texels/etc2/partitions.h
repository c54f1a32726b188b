// Divides the texels of a block in two, as starting points of the modes T and H.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/etc2/texel_set.h"

#include <array>
#include <cstddef>

namespace hearth::texels
{

/// Masks of one part; neither part is empty.
struct PartitionList
{
    std::array<TexelMask, 32> masks;
    size_t count = 0;

    const TexelMask* begin() const { return masks.data(); }
    const TexelMask* end() const { return masks.data() + count; }
};

/// List divisions by two means of colours, by two means of what is left of colours without gray, and with
/// Effort::high at each place between colours along both directions. None if all texels are equal.
PartitionList listPartitions(const Block8& block, const ColorWeights& weights, Effort effort);

} // namespace hearth::texels
