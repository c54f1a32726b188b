// Encodes blocks of single channels as EAC: alpha of ETC2, R11 and RG11.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/blocks/block_texels.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace hearth::texels
{

/// Block of an alpha channel.
struct EncodedAlpha
{
    std::array<std::byte, 8> bytes;
    uint32_t error; ///< sum of squares of differences, in codes of 8 bits
};

/// Block of R11.
struct EncodedR11
{
    std::array<std::byte, 8> bytes;
    uint64_t error; ///< sum of squares of differences, in codes of 16 bits
};

/// Block of RG11.
struct EncodedRg11
{
    std::array<std::byte, 16> bytes;
    uint64_t error; ///< sum of squares of differences of both channels, in codes of 16 bits
};

/// Encode alpha. Equal texels are exact.
/// alphas  rows from top to bottom
EncodedAlpha encodeEacAlpha(const std::array<uint8_t, 16>& alphas, Effort effort);

/// Encode an unsigned channel. Equal texels are exact if 11 bits have their value.
/// codes  unorm, rows from top to bottom
EncodedR11 encodeEacR11(const std::array<uint16_t, 16>& codes, Effort effort);

/// Encode red and green of a block, each by itself.
EncodedRg11 encodeEacRg11(const Block16& block, Effort effort);

} // namespace hearth::texels
