// Encodes BC1 without transparency, and the colours of BC3.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/bc/channel_weights.h"
#include "cook/texels/blocks/block_texels.h"

#include <cstddef>
#include <span>

namespace hearth::texels
{

/// Palettes that the colours of a block may use.
enum class Bc1Palettes : uint8_t
{
    all,       ///< of BC1: four colours, or three and black
    four_only, ///< of BC3
};

/// Encode the colours of a block. Alpha is ignored.
///
/// returns  error of the decoded colours, see ChannelWeights
uint32_t encodeBc1(const Block8& texels, const ChannelWeights& weights, Bc1Palettes palettes, Effort effort,
                   std::span<std::byte, 8> block);

} // namespace hearth::texels
