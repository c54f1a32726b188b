// Encodes BC4, BC5, and the alpha of BC3.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/blocks/block_texels.h"

#include <cstddef>
#include <span>

namespace hearth::texels
{

/// Encode a channel of a block of 16 bits, as BC4 and each half of BC5 have it.
///
/// channel  0 to 3
/// returns  sum of squares of decoded - source, in codes of 16 bits
uint64_t encodeBc4(const Block16& texels, size_t channel, Effort effort, std::span<std::byte, 8> block);

/// Encode red and green.
/// returns  as encodeBc4, the sum of both
uint64_t encodeBc5(const Block16& texels, Effort effort, std::span<std::byte, 16> block);

/// Encode the alpha of BC3.
/// returns  sum of squares of decoded - source, in codes of 8 bits
uint32_t encodeBc3Alpha(const Block8& texels, Effort effort, std::span<std::byte, 8> block);

} // namespace hearth::texels
