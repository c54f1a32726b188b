// Weights of channels in the error that encoders of BC minimise.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstdint>

namespace hearth::texels
{

/// Red, green, blue, alpha: the error of a block is the sum of weight * (decoded - source)^2 over its texels
/// and channels, in codes of 8 bits. 0 to kMaxChannelWeight each; 0: the channel does not matter.
using ChannelWeights = std::array<uint8_t, 4>;

/// Keeps sums over a block within 32 bits.
inline constexpr uint8_t kMaxChannelWeight = 64;

} // namespace hearth::texels
