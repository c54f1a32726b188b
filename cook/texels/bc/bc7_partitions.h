// Ranks the partitions of BC6H and BC7 for a block.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hearth::texels
{

/// Sort partitions by what they leave of the texels' variance when each subset becomes a line: the least
/// first.
///
/// values      [channel][texel]
/// channels    that count, from the first: 3 or 4
/// subsets     2 or 3
/// partitions  gets the best ones of the first `candidates`: at most 64
void rankPartitions(const std::array<std::array<int16_t, 16>, 4>& values, size_t channels, uint32_t subsets,
                    uint32_t candidates, std::span<uint8_t> partitions);

} // namespace hearth::texels
