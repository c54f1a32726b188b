// Texels of the blocks that encoders take.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstdint>

namespace hearth::texels
{

/// Texels of a 4x4 block, rows from top to bottom, each red, green, blue, alpha of 8 bits. Beyond the edge of
/// an image, the texel at the edge is repeated.
using Block8 = std::array<std::array<uint8_t, 4>, 16>;

/// The same with 16 bits a channel: unorm for EAC and BC4, BC5; half floats for BC6H.
using Block16 = std::array<std::array<uint16_t, 4>, 16>;

/// Time that an encoder may take.
enum class Effort : uint8_t
{
    draft,  ///< fastest: a designer waits
    normal, ///< default
    high,   ///< a release is built
};

} // namespace hearth::texels
