// Fits a line of colours between two stored endpoints to texels: what each subset of BC7 is.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hearth::texels
{

/// Texels that share endpoints, side by side for vector instructions.
struct LineTexels
{
    std::array<std::array<int16_t, 16>, 4> values; ///< [channel][texel]: 8 bits; 0 beyond count
    uint32_t count;
};

/// Lowest bit of stored endpoints: BC7's P-bit.
enum class LowestBit : uint8_t
{
    free,   ///< each channel has its own
    each,   ///< common to the channels of an endpoint
    shared, ///< common to both endpoints too
    set,    ///< common to the channels of an endpoint, and 1
};

/// Storage of the endpoints and indices of a line.
struct LineFormat
{
    std::array<uint8_t, 4>
        bits; ///< of a channel's code, the lowest bit included: 5 to 8. 0: the channel is 255
    LowestBit lowest;
    uint8_t index_bits; ///< 2 to 4
};

/// Error's weights: 0 to kMaxChannelWeight. Channels without weight get the highest code.
using LineWeights = std::array<int16_t, 4>;

/// Stored endpoints of a line.
struct Line
{
    std::array<std::array<uint8_t, 4>, 2> codes{}; ///< [end][channel]
    uint32_t error = UINT32_MAX;
};

/// Ends of the texels along their principal axis, in sixteenths of codes of 8 bits: [end][channel].
using LineEnds = std::array<std::array<int32_t, 4>, 2>;

LineEnds findEnds(const LineTexels& texels, const LineWeights& weights);

/// Find endpoints near `start` by least squares, as long as the error decreases.
/// rounds  of least squares, at most
Line fitLine(const LineTexels& texels, const LineWeights& weights, const LineFormat& format,
             const LineEnds& start, uint32_t rounds);

/// Move codes by one as long as the error decreases.
/// passes  over all codes, at most
void refineLine(const LineTexels& texels, const LineWeights& weights, const LineFormat& format,
                uint32_t passes, Line& line);

/// Widen a code to 8 bits; 255 for 0 bits.
constexpr int16_t widenCode(uint8_t code, uint8_t bits)
{
    return static_cast<int16_t>(bits == 0 ? 255 : (code << (8 - bits) | code >> (2 * bits - 8)));
}

/// Choose the nearest index of each texel.
/// returns  error of the line
uint32_t chooseLineIndices(const LineTexels& texels, const LineWeights& weights, const LineFormat& format,
                           const Line& line, std::array<uint8_t, 16>& indices);

} // namespace hearth::texels
