// Searches the planar mode of ETC2: colours that change evenly over the block.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/etc2/texel_set.h"

#include <array>
#include <cstdint>

namespace hearth::texels
{

/// Codes of a channel at the first texel, four texels to its right and four below it: 6 bits, green 7.
using PlanarCodes = std::array<int32_t, 3>;

struct PlanarSolution
{
    int32_t error = INT32_MAX;
    std::array<PlanarCodes, 3> channels{};
};

/// Find colours of little error.
/// limit  the search may end early if no error is below; the result then has error INT32_MAX
PlanarSolution searchPlanar(const Block8& block, const ColorWeights& weights, Effort effort, int32_t limit);

} // namespace hearth::texels
