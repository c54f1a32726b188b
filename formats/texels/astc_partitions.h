// Partitions of an ASTC block: which pair of endpoints each texel lies between.
// Source: Khronos Data Format Specification, section "Partition Pattern Generation".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <span>

namespace hearth::formats
{

/// Write the partition of each texel of a block, rows from top to bottom.
/// index       of the pattern, 0 to 1023
/// count       partitions, 2 to 4
/// partitions  block_width * block_height values below `count`
void writeAstcPartitions(uint32_t index, uint32_t count, uint32_t block_width, uint32_t block_height,
                         std::span<uint8_t> partitions);

} // namespace hearth::formats
