// Encodes BC7.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/bc/channel_weights.h"
#include "cook/texels/blocks/block_texels.h"

#include <cstddef>
#include <span>

namespace hearth::texels
{

/// Encode a block. Alpha that is 255 in all texels stays so in all, unless it has weight 0.
///
/// returns  error of the decoded texels, see ChannelWeights
uint32_t encodeBc7(const Block8& texels, const ChannelWeights& weights, Effort effort,
                   std::span<std::byte, 16> block);

} // namespace hearth::texels
