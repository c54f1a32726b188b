// Slow encoders of BC1 and BC7 that say how small the error of a block can be: exhaustive over modes,
// partitions and rotations, and with endpoints descended to from many starts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstdint>

namespace hearth::bench
{

/// Texels of a block, rows from top to bottom, red, green, blue, alpha of 8 bits.
using OracleBlock = std::array<std::array<uint8_t, 4>, 16>;

/// Return the least error that was found: sum of the squares of decoded - source over red, green and blue.
uint64_t oracleBc1(const OracleBlock& block);

/// The same for BC7; over red, green, blue and alpha if `has_alpha`.
uint64_t oracleBc7(const OracleBlock& block, bool has_alpha);

} // namespace hearth::bench
