// Encodes BC6H without a sign.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/blocks/block_texels.h"

#include <cstddef>
#include <span>

namespace hearth::texels
{

/// Encode red, green and blue of half floats. Negative values and NaN become 0, infinity the largest half.
///
/// returns  sum of squares of decoded - source over texels and channels, in units of the halves'
///          bits: for values above 2^-14 these ascend by octaves, so the error is relative
uint64_t encodeBc6h(const Block16& texels, Effort effort, std::span<std::byte, 16> block);

} // namespace hearth::texels
