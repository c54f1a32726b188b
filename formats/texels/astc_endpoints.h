// Endpoints of an ASTC block: the two colours that the texels of a partition lie between.
// Source: Khronos Data Format Specification, sections "Endpoint Unquantization" and "Endpoint
// Interpretation".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hearth::formats
{

inline constexpr size_t kMaxAstcEndpointValues = 18; ///< of all partitions of a block

/// Pair of colours. LDR channels have 8 bits; HDR ones have 12, by the logarithm.
struct AstcEndpoints
{
    std::array<int32_t, 4> low, high;
    bool hdr_rgb, hdr_alpha;
};

/// Return the stored values that a mode takes: 2, 4, 6 or 8.
constexpr size_t astcEndpointValues(uint32_t mode)
{
    return 2 * (mode / 4 + 1);
}

/// Return true if a mode has any HDR channel.
constexpr bool isAstcModeHdr(uint32_t mode)
{
    return mode == 2 || mode == 3 || mode == 7 || mode == 11 || mode == 14 || mode == 15;
}

/// Return the value from 0 to 255 of a stored value.
/// range  of kAstcRanges, from kMinAstcColourRange on
uint8_t unquantizeAstcColour(size_t range, uint8_t stored);

/// Decode the endpoints of a partition.
/// mode    0 to 15
/// values  astcEndpointValues(mode), each from 0 to 255
AstcEndpoints decodeAstcEndpoints(uint32_t mode, std::span<const uint8_t> values);

} // namespace hearth::formats
