// Encodes ETC2 and EAC by exhaustion, as an oracle of the fast encoders: seconds for a few blocks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/blocks/block_texels.h"

#include <array>
#include <cstdint>

namespace hearth::bench
{

/// Return the least sum of squares of ETC2's RGB8. Exact for the modes individual, differential and planar:
/// all blocks are tried. T and H start from all pairs of texels' colours, and the best starts descend.
uint32_t leastColorError(const texels::Block8& block);

/// Return the least sum of squares of EAC's alpha, by all blocks.
uint32_t leastAlphaError(const std::array<uint8_t, 16>& alphas);

/// Return the least sum of squares of R11, by all blocks, in codes of 16 bits.
uint64_t leastR11Error(const std::array<uint16_t, 16>& codes);

} // namespace hearth::bench
